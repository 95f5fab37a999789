import type { VideoCodec, VideoDescription } from '@farpoint/protocol';
import type { Logger } from '@farpoint/service';
import { CodecChoice } from './codec-choice.ts';
import type { VideoCamera } from './video-encoder.ts';
import type { EncodedPicture, VideoFrame } from './video-frame.ts';
import { VideoStream, type VideoWish } from './video-stream.ts';

/** Takes videos as they are encoded for operators, for example to record them. */
export interface VideoTaker {
  /** Whether a video is to be encoded although no operator can watch it. */
  wants(video: number): boolean;
  /** @param codec of the picture: it may change from key frame to key frame */
  take(video: number, picture: EncodedPicture, codec: VideoCodec): void;
}

/** An operator who may watch videos. */
export interface VideoTarget {
  /** The operator's id, as known to the guard. */
  readonly id: string;
  readonly streaming: boolean;
  readonly wantedVideos: ReadonlySet<number>;
  /** What it decodes of a video. */
  videoCodecs(video: number): ReadonlySet<VideoCodec>;
  /** Whether they are to carry their capture time. */
  readonly wantsBarcode: boolean;
  /** How much of the operator's path a video may take, bit/s without headers. */
  videoBitsPerSecond(video: number): number;
  offerVideo(frame: VideoFrame): void;
}

export interface VideoHubOptions {
  cameras: readonly VideoCamera[];
  targets: () => Iterable<VideoTarget>;
  /** The operator whose path decides the rates; `null` if nobody drives. */
  driver: () => string | null;
  /** Takes the videos, too; `null` for nobody. */
  taker: VideoTaker | null;
  /** A video has stopped or returned, or has another codec. */
  onStateChanged: () => void;
  /** Sends what is due. */
  onFrame: () => void;
  log: Pick<Logger, 'info' | 'warn'>;
}

/** Shortest time between two plans, ms: rates change with the feedback, many times a second. */
const PLAN_MS = 200;

/** All cameras that are streamed as video. Each is encoded once, while anybody wants it, for all who do. */
export class VideoHub {
  readonly streams: readonly VideoStream[];
  readonly #options: VideoHubOptions;
  readonly #choices: readonly CodecChoice[];
  #plannedMs = Number.NEGATIVE_INFINITY;

  constructor(options: VideoHubOptions) {
    this.#options = options;
    this.streams = options.cameras.map(
      (camera, video) =>
        new VideoStream(video, camera, {
          onPicture: (picture, codec) => options.taker?.take(video, picture, codec),
          onFrame: (frame) => {
            for (const target of options.targets()) if (target.streaming) target.offerVideo(frame);
            options.onFrame();
          },
          onFault: (fault) => {
            if (fault === null) options.log.info({ camera: camera.name }, 'a camera’s video is back');
            else options.log.warn({ camera: camera.name, detail: fault }, 'a camera has no video');
            options.onStateChanged();
          },
          onBadPicture: (detail) =>
            options.log.warn({ camera: camera.name, detail }, 'a picture was dropped'),
        }),
    );
    this.#choices = options.cameras.map(({ codecs }) => new CodecChoice(codecs));
  }

  /** Of each video what an operator is told, besides its m-line. */
  get descriptions(): Omit<VideoDescription, 'mid'>[] {
    return this.streams.map(({ camera: { name, ofSensor }, codec, fault }) => ({
      name,
      codec,
      ...(ofSensor === undefined ? {} : { ofSensor }),
      ...(fault === null ? {} : { fault: fault.slice(0, 256) }),
    }));
  }

  /**
   * A video's highest rate, bit/s without headers; 0 while it has no pictures, so that others get its share.
   *
   * @param codecs of whoever shall get it
   */
  mostBitsPerSecond(video: number, codecs: ReadonlySet<VideoCodec>): number {
    const stream = this.streams[video];
    const has = stream !== undefined && stream.fault === null && codecs.has(stream.codec);
    return has ? stream.camera.most.bitsPerSecond : 0;
  }

  requestKeyFrame(video: number): void {
    this.streams[video]?.requestKeyFrame();
  }

  /** Call often; plans a few times a second. */
  update(nowMs: number): void {
    if (nowMs - this.#plannedMs < PLAN_MS) return;
    this.#plannedMs = nowMs;
    for (const stream of this.streams) {
      const watching = this.#watching(stream.video);
      // Those who can watch it only now have no share for it yet: their budgets follow.
      if (this.#chooseCodec(stream, watching, nowMs)) this.#plannedMs = Number.NEGATIVE_INFINITY;
      else stream.plan(this.#wish(stream, watching), nowMs);
    }
  }

  async close(): Promise<void> {
    await Promise.all(this.streams.map((stream) => stream.close()));
  }

  #watching(video: number): VideoTarget[] {
    return [...this.#options.targets()].filter(
      ({ streaming, wantedVideos }) => streaming && wantedVideos.has(video),
    );
  }

  /** @returns whether it has another from now on */
  #chooseCodec(stream: VideoStream, watching: readonly VideoTarget[], nowMs: number): boolean {
    const { driver, log, onStateChanged } = this.#options;
    const holder = driver();
    const watchers = watching.map((target) => ({
      codecs: target.videoCodecs(stream.video),
      drives: target.id === holder,
    }));
    const codec = this.#choices[stream.video]?.update(watchers, stream.format === null, nowMs);
    if (codec === undefined || !stream.useCodec(codec)) return false;
    log.info({ camera: stream.camera.name, codec }, 'a camera has another codec');
    onStateChanged();
    return true;
  }

  /**
   * The driver's path decides; without a driver among those who watch, the narrowest path does.
   *
   * @returns `null` if nobody wants the video
   */
  #wish({ video, codec }: VideoStream, watching: readonly VideoTarget[]): VideoWish | null {
    const anyway = this.#options.taker?.wants(video) ?? false;
    const seeing = watching.filter((target) => target.videoCodecs(video).has(codec));
    const driver = seeing.find(({ id }) => id === this.#options.driver());
    const deciding = driver === undefined ? seeing : [driver];
    if (deciding.length === 0) return anyway ? { bitsPerSecond: 0, anyway, barcode: false } : null;
    return {
      anyway,
      bitsPerSecond: Math.min(...deciding.map((target) => target.videoBitsPerSecond(video))),
      barcode: seeing.some(({ wantsBarcode }) => wantsBarcode),
    };
  }
}
