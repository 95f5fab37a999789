/** Messages between the page and the worker that decodes videos. */
import type { VideoCodec } from '@farpoint/operator';
import type { FrameDropReason } from './decode-gate.ts';

/** Options of a receiver's `RTCRtpScriptTransform`. */
export interface VideoTransformOptions {
  /** Identifies the receiver in the messages. */
  readonly receiver: number;
}

/**
 * How frames of this receiver are to be decoded: not at all (`null`) at first. Where the browser tells a frame's codec
 * itself, that counts: frames may come sooner than the message.
 */
export interface ToVideoWorker {
  readonly receiver: number;
  readonly codec: VideoCodec | null;
}

export type FromVideoWorker =
  /** Whoever takes the frame closes it. */
  | { receiver: number; type: 'frame'; frame: VideoFrame; rtpTimestamp: number }
  /** Frames that were not decoded so far, by reason; after a drop, a few times a second at most. */
  | { receiver: number; type: 'drops'; drops: Record<FrameDropReason, number> }
  /** The browser cannot decode this video. */
  | { receiver: number; type: 'unsupported'; detail: string };
