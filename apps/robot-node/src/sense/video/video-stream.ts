import type { VideoCodec } from '@farpoint/protocol';
import { VideoPayloadError } from '@farpoint/rtp';
import { ReasonCounts } from '../../ground/robot-counters.ts';
import { RateTrim } from './rate-trim.ts';
import type { VideoCamera, VideoEncoder } from './video-encoder.ts';
import { type EncodedPicture, VideoFrame } from './video-frame.ts';
import { type EncodedFormat, VideoPlanner } from './video-plan.ts';

export interface VideoStreamEvents {
  /** A picture is encoded: called before `onFrame`, also while the operators' path carries no video. */
  onPicture(picture: EncodedPicture, codec: VideoCodec): void;
  /** A frame for operators. */
  onFrame(frame: VideoFrame): void;
  onFault(fault: string | null): void;
  /** The encoder gave bytes that are no picture. */
  onBadPicture(detail: string): void;
}

/** What those who watch a video want of it together. */
export interface VideoWish {
  /** What it may take, without headers; too little for any picture if only others than operators want it. */
  bitsPerSecond: number;
  /** It is encoded even if that is too little, then at its full rate, for others than operators. */
  anyway: boolean;
  /** Whether its pictures are to carry their capture time. */
  barcode: boolean;
}

/**
 * After the last operator has switched a video off, its camera stays open for this long, ms: a page may be
 * reloading. Chosen: most are there again by then, and to open a camera anew interrupts it.
 */
const LINGER_MS = 3000;
/**
 * Smaller changes of the bit rate are not worth telling the encoder. Chosen: far below what encoders are off
 * by (docs/video.md).
 */
const RATE_STEP = 0.03;
/** VP8's picture id has 15 bits. */
const PICTURE_IDS = 0x8000;

/** One camera's video: opens and closes its encoder, plans its format, and packetises what it encodes. */
export class VideoStream {
  readonly video: number;
  readonly camera: VideoCamera;
  /** Why there are no pictures; `null` while there are, or nobody watches. */
  fault: string | null = null;
  readonly counters = { frames: 0, keyFrames: 0, bytes: 0, badPictures: 0 };
  /** How often the encoder, or what feeds it, has ended, by reason. */
  readonly failures = new ReasonCounts();
  readonly #events: VideoStreamEvents;
  readonly #planner: VideoPlanner;
  #codec: VideoCodec;
  /** Of the present encoder. */
  #trim = new RateTrim();
  #encoder: VideoEncoder | null = null;
  /** The encoder before, while it closes: two cannot have one camera. */
  #closing: Promise<void> | null = null;
  #format: EncodedFormat | null = null;
  #wantedMs = 0;
  #droppedBefore = 0;
  #lastCapturedMs = Number.NEGATIVE_INFINITY;
  #pictureId = 0;
  /** Nothing of the present codec can be decoded yet. */
  #needsKey = false;
  /** The operators' path carries no video at present. */
  #paused = false;
  /** Nothing that the encoder gives is used at present. */
  #idle = false;

  constructor(video: number, camera: VideoCamera, events: VideoStreamEvents) {
    this.video = video;
    this.camera = camera;
    this.#codec = camera.codecs[0] as VideoCodec;
    this.#events = events;
    this.#planner = new VideoPlanner(camera.most);
  }

  /** What it is encoded with, or would be if anybody watched. */
  get codec(): VideoCodec {
    return this.#codec;
  }

  /** What is encoded at present; `null` if the camera is closed. */
  get format(): Readonly<EncodedFormat> | null {
    return this.#format;
  }

  /** Pictures that a slow encoder has skipped. */
  get dropped(): number {
    return this.#droppedBefore + (this.#encoder?.dropped ?? 0);
  }

  requestKeyFrame(): void {
    this.#encoder?.requestKeyFrame();
  }

  /**
   * Encodes with another of the camera's codecs: its encoder is closed, and the next begins with a key frame.
   *
   * @returns whether that is a change
   */
  useCodec(codec: VideoCodec): boolean {
    if (codec === this.#codec) return false;
    this.#codec = codec;
    this.#trim = new RateTrim();
    this.fault = null;
    this.#needsKey = true;
    void this.#closeEncoder();
    return true;
  }

  /** @param wish `null` if nobody wants the video */
  plan(wish: VideoWish | null, nowMs: number): void {
    if (wish === null) {
      if (this.#format !== null && nowMs - this.#wantedMs >= LINGER_MS) void this.close();
      return;
    }
    this.#wantedMs = nowMs;
    const forOperators = this.#planner.plan(wish.bitsPerSecond);
    const wasPaused = this.#paused;
    this.#paused = forOperators === null;
    const planned = forOperators ?? (wish.anyway ? this.#planner.plan(this.camera.most.bitsPerSecond) : null);
    this.#idle = planned === null;
    if (planned === null) return;
    const next = { ...planned, barcode: wish.barcode };
    if (this.#encoder === null) this.#open(next);
    else if (isWorthTelling(this.#format, next)) {
      this.#format = next;
      this.#trim.reset();
      this.#configure(next);
    }
    if (wasPaused && !this.#paused) this.requestKeyFrame();
  }

  async close(): Promise<void> {
    this.#format = null;
    this.fault = null;
    await this.#closeEncoder();
  }

  /** Resolves when the camera is free. What is wanted then is opened. */
  async #closeEncoder(): Promise<void> {
    const encoder = this.#encoder;
    if (encoder !== null) {
      this.#encoder = null;
      this.#droppedBefore += encoder.dropped;
      this.#closing = encoder.close().then(() => {
        this.#closing = null;
        if (this.#format !== null) this.#open(this.#format);
      });
    }
    await this.#closing;
  }

  /** Tells the encoder what to give, corrected by what it gave. */
  #configure(format: EncodedFormat): void {
    const bitsPerSecond = Math.round(format.bitsPerSecond * this.#trim.factor);
    this.#encoder?.configure({ ...format, bitsPerSecond });
  }

  #open(format: EncodedFormat): void {
    this.#format = format;
    if (this.#closing !== null) return;
    this.#trim.reset();
    const encoder = this.camera.open(this.#codec, format, {
      onPicture: (picture) => {
        if (this.#encoder === encoder) this.#onPicture(picture);
      },
      onFault: (fault, reason) => {
        if (this.#encoder !== encoder) return;
        if (reason !== undefined) this.failures.add(reason);
        if (fault === this.fault) return;
        this.fault = fault;
        this.#events.onFault(fault);
      },
    });
    this.#encoder = encoder;
  }

  #onPicture(picture: EncodedPicture): void {
    const format = this.#format;
    // Receivers take equal or falling timestamps for parts of one picture, or for a fault.
    if (format === null || this.#idle || picture.capturedAtMs <= this.#lastCapturedMs) return;
    if (this.#needsKey && !picture.key) {
      // Its first was older than what was shown before: a played recording begins so.
      this.requestKeyFrame();
      return;
    }
    this.#needsKey = false;
    const { framesPerSecond, bitsPerSecond } = format;
    if (this.#trim.onPicture(picture.bytes.length, bitsPerSecond / 8 / framesPerSecond))
      this.#configure(format);
    const { video, counters, codec } = this;
    let frame: VideoFrame;
    try {
      frame = new VideoFrame(picture, { video, codec, pictureId: this.#pictureId, framesPerSecond });
    } catch (error) {
      if (!(error instanceof VideoPayloadError)) throw error;
      counters.badPictures++;
      this.#events.onBadPicture(error.message);
      return;
    }
    this.#lastCapturedMs = picture.capturedAtMs;
    this.#pictureId = (this.#pictureId + 1) % PICTURE_IDS;
    counters.frames++;
    counters.bytes += picture.bytes.length;
    if (picture.key) counters.keyFrames++;
    this.#events.onPicture(picture, codec);
    if (!this.#paused) this.#events.onFrame(frame);
  }
}

function isWorthTelling(now: EncodedFormat | null, next: EncodedFormat): boolean {
  if (now === null) return true;
  const { width, height, framesPerSecond, bitsPerSecond, barcode } = now;
  return (
    next.width !== width ||
    next.height !== height ||
    next.framesPerSecond !== framesPerSecond ||
    next.barcode !== barcode ||
    Math.abs(next.bitsPerSecond - bitsPerSecond) > bitsPerSecond * RATE_STEP
  );
}
