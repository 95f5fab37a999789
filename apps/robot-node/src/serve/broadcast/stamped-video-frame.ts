import { CAPTURE_STAMP_BYTES, captureStampNal, writeCaptureStamp } from '@farpoint/protocol';
import { nsOfMs } from '@farpoint/timing';
import type { OutgoingFrame } from '../../ground/outgoing-frame.ts';
import { VIDEO_OVERHEAD_BYTES, type VideoFrame } from '../../sense/video/video-frame.ts';

/**
 * A video's frame with its capture time inside the bitstream, because a relay rewrites timestamps and header extensions.
 * The frame's own packets are shared with the operators'. In H.264 the time is a packet before them, in VP8 it follows
 * the frame's last bytes.
 */
export class StampedVideoFrame implements OutgoingFrame {
  readonly video: number;
  readonly stream: number;
  readonly lane: number;
  readonly packets: number;
  readonly bytes: number;
  readonly points = 0;
  readonly rtpTimestamp: number;
  readonly capturedAtMs: number;
  readonly usefulMs: number;
  readonly maxSpanMs: number;
  readonly maxWaitingFrames: number;
  readonly needsPrevious: boolean;
  readonly #frame: VideoFrame;
  /** H.264: the first payload. */
  readonly #first: Uint8Array | null;
  /** VP8: the last payload. */
  readonly #last: Uint8Array | null;

  constructor(frame: VideoFrame) {
    this.video = frame.video;
    this.stream = frame.stream;
    this.lane = frame.lane;
    this.rtpTimestamp = frame.rtpTimestamp;
    this.capturedAtMs = frame.capturedAtMs;
    this.usefulMs = frame.usefulMs;
    this.maxSpanMs = frame.maxSpanMs;
    this.maxWaitingFrames = frame.maxWaitingFrames;
    this.needsPrevious = frame.needsPrevious;
    this.#frame = frame;
    const captureNs = nsOfMs(frame.capturedAtMs);
    if (frame.codec === 'H264') {
      this.#first = captureStampNal(captureNs);
      this.#last = null;
      this.packets = frame.packets + 1;
      this.bytes = frame.bytes + this.#first.length + VIDEO_OVERHEAD_BYTES;
    } else {
      this.#first = null;
      this.#last = joined(frame.payload(frame.packets - 1), writeCaptureStamp(captureNs));
      this.packets = frame.packets;
      this.bytes = frame.bytes + CAPTURE_STAMP_BYTES;
    }
  }

  payload(index: number): Uint8Array {
    if (this.#first !== null) return index === 0 ? this.#first : this.#frame.payload(index - 1);
    return index === this.packets - 1 ? (this.#last as Uint8Array) : this.#frame.payload(index);
  }

  /** Nothing is reused: encoded pictures are small. */
  hold(): this {
    return this;
  }

  release(): void {}
}

function joined(first: Uint8Array, second: Uint8Array): Uint8Array {
  const bytes = new Uint8Array(first.length + second.length);
  bytes.set(first);
  bytes.set(second, first.length);
  return bytes;
}
