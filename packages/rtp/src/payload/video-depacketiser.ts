/** Puts encoded pictures together again from the RTP payloads of a video stream. */
import { SequenceNumber } from '../sequence-number.ts';
import { FrameBuffer } from './frame-buffer.ts';
import { H264Reader } from './h264-reader.ts';
import type { PayloadFault, PayloadReader } from './payload-reader.ts';
import { Vp8Reader } from './vp8-reader.ts';

/** Why a frame of which something arrived is not returned; `late` counts packets. */
export type VideoFrameDrop =
  | PayloadFault
  | 'lost-packet' // a packet of it is missing, or may be
  | 'no-marker' // the next frame began before its last packet
  | 'awaiting-key-frame' // whole, but it builds on a frame that is not
  | 'late'; // a packet that repeats one of the last, or comes after it

export interface VideoDepacketiserOptions {
  /** Longest frame, bytes; this bounds the memory. Default 4 MiB. */
  maxFrameBytes?: number;
  /**
   * Whether to return nothing until the first key frame, and after each loss until the next one. Without this, a
   * decoder must cope with frames that build on a lost one.
   */
  waitForKeyFrame?: boolean;
}

export interface WholeVideoFrame {
  /** RTP timestamp, in units of the stream's clock. */
  timestamp: number;
  /** A decoder can begin with it. For H.264, it then has the parameter sets of this or of an earlier frame. */
  isKeyFrame: boolean;
  /** H.264 in Annex B's byte stream format with start codes of 4 bytes; VP8 as it was encoded. */
  bytes: Uint8Array<ArrayBuffer>;
}

/** How far a repeated packet may lie behind; further back, the stream has begun anew (RFC 3550 appendix A.1). */
const MAX_LATE = 100;

/**
 * For one stream of H.264 (RFC 6184, packetization-mode 1) or VP8 (RFC 7741). Takes packets in the order of their
 * sequence numbers: a missing number is a lost packet. Bytes from outside never make it throw.
 */
export class VideoDepacketiser {
  readonly drops: Record<VideoFrameDrop, number> = {
    malformed: 0,
    'too-large': 0,
    'lost-packet': 0,
    'no-marker': 0,
    'awaiting-key-frame': 0,
    late: 0,
  };
  readonly #reader: PayloadReader;
  readonly #frame: FrameBuffer;
  readonly #waitForKeyFrame: boolean;
  #needsKeyFrame: boolean;
  /** The sequence number to come. */
  #next: number | null = null;
  #timestamp = 0;
  /** Of the frame with this timestamp: nothing yet, all so far, or something that makes the rest useless. */
  #state: 'between' | 'open' | 'spoilt' = 'between';
  /** Packets may be missing between the last frame and the next packet. */
  #isAfterGap = true;

  /** @throws {RangeError} if `maxFrameBytes` is no positive whole number */
  constructor(codec: 'h264' | 'vp8', options: VideoDepacketiserOptions = {}) {
    const { maxFrameBytes = 4 * 1024 * 1024, waitForKeyFrame = false } = options;
    if (!Number.isSafeInteger(maxFrameBytes) || maxFrameBytes < 1)
      throw new RangeError(`maxFrameBytes ${maxFrameBytes} is no positive whole number`);
    this.#reader = codec === 'h264' ? new H264Reader() : new Vp8Reader();
    this.#frame = new FrameBuffer(maxFrameBytes);
    this.#waitForKeyFrame = waitForKeyFrame;
    this.#needsKeyFrame = waitForKeyFrame;
  }

  /** Whether nothing is returned before the next key frame: time to request one (RFC 4585 §6.3.1). */
  get needsKeyFrame(): boolean {
    return this.#needsKeyFrame;
  }

  /**
   * Takes one packet.
   *
   * @param sequence RTP sequence number, 16 bits
   * @param timestamp RTP timestamp, 32 bits
   * @param marker whether the packet is the last of its frame
   * @param payload without RTP header and padding; an empty one counts as padding and belongs to no frame
   * @returns the frame that it completes, else `null`
   */
  take(sequence: number, timestamp: number, marker: boolean, payload: Uint8Array): WholeVideoFrame | null {
    const ahead = this.#next === null ? 0 : SequenceNumber.ahead(sequence, this.#next);
    if (ahead < 0 && ahead >= -MAX_LATE) return this.#count('late');
    this.#next = SequenceNumber.next(sequence);
    if (ahead !== 0) this.#onGap();
    if (payload.length === 0) return null;
    if (this.#state !== 'between' && timestamp !== this.#timestamp) {
      if (this.#state === 'open') this.#drop('no-marker');
      this.#state = 'between';
    }
    this.#timestamp = timestamp;
    if (this.#state === 'between') this.#begin(payload);
    if (this.#state === 'open') {
      const fault = this.#reader.append(payload, this.#frame);
      if (fault !== null) this.#drop(fault);
    }
    if (!marker) return null;
    const isWhole = this.#state === 'open';
    this.#state = 'between';
    this.#isAfterGap = false;
    return isWhole ? this.#finish() : null;
  }

  #onGap(): void {
    this.#isAfterGap = true;
    this.#needsKeyFrame = this.#waitForKeyFrame;
    if (this.#state === 'open') this.#drop('lost-packet');
  }

  #begin(payload: Uint8Array): void {
    this.#frame.clear();
    this.#reader.reset();
    this.#state = 'open';
    if (this.#isAfterGap && !this.#reader.beginsFrame(payload)) this.#drop('lost-packet');
    this.#isAfterGap = false;
  }

  #finish(): WholeVideoFrame | null {
    const kind = this.#reader.finish(this.#frame.bytes);
    if (kind === null) {
      this.#needsKeyFrame = this.#waitForKeyFrame;
      return this.#count('malformed');
    }
    if (this.#needsKeyFrame && !kind.isKeyFrame) return this.#count('awaiting-key-frame');
    this.#needsKeyFrame = false;
    return { timestamp: this.#timestamp, isKeyFrame: kind.isKeyFrame, bytes: this.#frame.bytes.slice() };
  }

  #drop(reason: VideoFrameDrop): void {
    this.#count(reason);
    this.#state = 'spoilt';
    this.#needsKeyFrame = this.#waitForKeyFrame;
  }

  #count(reason: VideoFrameDrop): null {
    this.drops[reason]++;
    return null;
  }
}
