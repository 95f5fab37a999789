/** Stand-ins for a camera's encoder and for an operator: the tests of what is between them play both. */
import { VIDEO_CODECS, type VideoCodec } from '@farpoint/protocol';
import type { VideoEncoder, VideoEncoderEvents } from '../video-encoder.ts';
import type { VideoFrame } from '../video-frame.ts';
import type { VideoTarget } from '../video-hub.ts';
import type { EncodedFormat } from '../video-plan.ts';

/** Records what it is told; the test plays the camera. */
export class FakeEncoder implements VideoEncoder {
  readonly codec: VideoCodec;
  readonly events: VideoEncoderEvents;
  readonly formats: EncodedFormat[];
  keyFrames = 0;
  dropped = 0;
  closed = false;
  readonly #closing = Promise.withResolvers<void>();
  readonly #isSlow: boolean;

  /** @param isSlow its closing takes until `gone` is called */
  constructor(codec: VideoCodec, format: EncodedFormat, events: VideoEncoderEvents, isSlow = false) {
    this.#isSlow = isSlow;
    this.codec = codec;
    this.formats = [format];
    this.events = events;
  }

  configure(format: EncodedFormat): void {
    this.formats.push(format);
  }

  requestKeyFrame(): void {
    this.keyFrames++;
  }

  close(): Promise<void> {
    this.closed = true;
    if (!this.#isSlow) this.gone();
    return this.#closing.promise;
  }

  /** Its closing ends. */
  gone(): void {
    this.#closing.resolve();
  }

  /** A key frame, or one that builds on others. */
  picture(capturedAtMs: number, key = true): void {
    const bytes = new Uint8Array(2000).fill(1);
    if (this.codec === 'H264') bytes.set([0, 0, 0, 1, key ? 0x65 : 0x41, 0x88]);
    else bytes.set(key ? [0x10, 0, 0, 0x9d, 0x01, 0x2a, 0x80, 0x02, 0xe0, 0x01] : [0x11]);
    this.events.onPicture({ bytes, key, capturedAtMs, width: 640, height: 480 });
  }
}

/** Records the frames that it is offered. */
export class FakeOperator implements VideoTarget {
  readonly id: string;
  streaming = true;
  wantsBarcode = false;
  wantedVideos: ReadonlySet<number> = new Set([0]);
  codecs: ReadonlySet<VideoCodec>;
  bitsPerSecond: number;
  readonly frames: VideoFrame[] = [];

  constructor(id: string, bitsPerSecond: number, codecs: readonly VideoCodec[] = VIDEO_CODECS) {
    this.id = id;
    this.codecs = new Set(codecs);
    this.bitsPerSecond = bitsPerSecond;
  }

  videoCodecs(): ReadonlySet<VideoCodec> {
    return this.codecs;
  }

  videoBitsPerSecond(): number {
    return this.bitsPerSecond;
  }

  offerVideo(frame: VideoFrame): void {
    this.frames.push(frame);
  }
}
