/** Decides which encoded frames of a video a decoder gets, and when a key frame is needed. Time is an argument. */
import type { VideoCodec } from '@farpoint/operator';
import { sequenceDelta32 } from '@farpoint/protocol';
import { readAccessUnit } from './annex-b.ts';

/** Why a frame is not decoded. */
export type FrameDropReason =
  /** Decoding has not begun, or has been interrupted, and the frame needs earlier ones. */
  | 'waits-for-key'
  /** It came after a later one that was decoded without it. */
  | 'out-of-order'
  /** The decoder has fallen behind. */
  | 'decoder-busy'
  /** The decoder failed. */
  | 'decoder-failed';

/** An encoded frame as it arrived. */
export interface EncodedFrame {
  readonly isKey: boolean;
  readonly rtpTimestamp: number;
  readonly bytes: Uint8Array;
}

export type GateDecision =
  | {
      readonly decode: true;
      /** Of a key frame: what the decoder is to be configured with, if that differs from before. */
      readonly configure: string | null;
      readonly isKey: boolean;
      /** The RTP timestamp without wraps: counts on from the first frame's. */
      readonly ticks: number;
    }
  | { readonly decode: false; readonly reason: FrameDropReason };

/**
 * Frames in the decoder, at most. A decoder that is this far behind would show the past. Chosen: a fifth of a
 * second at 30 a second; decode-gate.test.ts holds it.
 */
const MOST_IN_DECODER = 6;
/**
 * A key frame that does not come is asked for again after this time, ms. Chosen: a little more than the robot
 * needs between two (packages/video: 300 ms).
 */
const ASK_AGAIN_MS = 500;

export class DecodeGate {
  readonly drops: Record<FrameDropReason, number> = {
    'waits-for-key': 0,
    'out-of-order': 0,
    'decoder-busy': 0,
    'decoder-failed': 0,
  };
  readonly #codec: VideoCodec;
  #configured: string | null = null;
  #needsKey = true;
  #ticks: number | null = null;
  #askedMs = Number.NEGATIVE_INFINITY;

  constructor(codec: VideoCodec) {
    this.#codec = codec;
  }

  /** @param inDecoder frames that the decoder has not finished */
  decide({ isKey: saysKey, rtpTimestamp, bytes }: EncodedFrame, inDecoder: number): GateDecision {
    const { codec, isKey } =
      this.#codec === 'VP8' ? { codec: 'vp8', isKey: saysKey } : saysKey ? readAccessUnit(bytes) : NO_KEY;
    const behind = this.#ticks === null ? 1 : sequenceDelta32(rtpTimestamp, this.#ticks >>> 0);
    // The decoder has lost what this frame would have been: the later ones show it.
    if (behind <= 0) return this.#drop('out-of-order', true);
    this.#ticks = this.#ticks === null ? rtpTimestamp : this.#ticks + behind;
    if (!isKey && this.#needsKey) return this.#drop('waits-for-key', false);
    if (inDecoder >= MOST_IN_DECODER) return this.#drop('decoder-busy', true);
    const configure = isKey && (this.#needsKey || codec !== this.#configured) ? codec : null;
    if (configure !== null) this.#configured = configure;
    this.#needsKey = false;
    return { decode: true, configure, isKey, ticks: this.#ticks };
  }

  /** The decoder has failed, or was closed: it needs a key frame. */
  restart(reason: 'failed' | 'closed'): void {
    if (reason === 'failed') this.drops['decoder-failed']++;
    this.#needsKey = true;
  }

  /** Whether a key frame is to be asked for now. The browser asks for one by itself where it notices a loss. */
  asksForKey(nowMs: number): boolean {
    if (!this.#needsKey || nowMs < this.#askedMs + ASK_AGAIN_MS) return false;
    this.#askedMs = nowMs;
    return true;
  }

  #drop(reason: FrameDropReason, needsKey: boolean): GateDecision {
    this.drops[reason]++;
    if (needsKey) this.#needsKey = true;
    return { decode: false, reason };
  }
}

const NO_KEY = { codec: null, isKey: false } as const;
