import { CLOUD_MEDIA } from '@farpoint/protocol';
import { rtpTimestamp } from '@farpoint/rtp';
import type { OutgoingFrame } from '../../ground/outgoing-frame.ts';
import type { ReadyFrame } from '../../sense/capture/capture-messages.ts';
import { slotPayload, slotPayloadBytes } from '../../sense/encode/packetiser.ts';

/**
 * A frame takes one interval to send. When it has taken this many, its farthest points are dropped. Chosen:
 * by then the next frame waits, and would be late by another interval.
 */
const MOST_INTERVALS = 2;

/** One captured cloud on its way to several operators. Its buffer is returned when the last of them has released it. */
export class SharedFrame implements OutgoingFrame {
  readonly stream = 0;
  readonly frame: ReadyFrame;
  readonly slots: Uint8Array;
  readonly packets: number;
  /** Size on the wire with the transport's headers, bytes. */
  readonly bytes: number;
  /** RTP timestamp: capture time in 1/48000 s, u32. */
  readonly rtpTimestamp: number;
  /** While a newer frame waits, the rest of this one may be sent for this long after its first packet. */
  readonly maxSpanMs: number;
  readonly lane: number;
  #holders = 1;
  readonly #recycle: (buffer: ArrayBuffer) => void;

  /**
   * The creator holds the frame first and must `release` it.
   *
   * @param lane the pacer's lane; frames in lower lanes go first
   */
  constructor(frame: ReadyFrame, overheadBytes: number, recycle: (buffer: ArrayBuffer) => void, lane = 0) {
    this.lane = lane;
    this.frame = frame;
    this.slots = new Uint8Array(frame.buffer);
    this.packets = frame.packets;
    let bytes = frame.packets * overheadBytes;
    for (let i = 0; i < frame.packets; i++) bytes += slotPayloadBytes(this.slots, i);
    this.bytes = bytes;
    this.rtpTimestamp = rtpTimestamp(frame.capturedAtMs, CLOUD_MEDIA.clockRate);
    this.maxSpanMs = frame.intervalMs * MOST_INTERVALS;
    this.#recycle = recycle;
  }

  get points(): number {
    return this.frame.points;
  }

  get capturedAtMs(): number {
    return this.frame.capturedAtMs;
  }

  /** The next frame replaces it. */
  get usefulMs(): number {
    return this.frame.intervalMs;
  }

  payload(index: number): Uint8Array {
    return slotPayload(this.slots, index);
  }

  hold(): this {
    this.#holders++;
    return this;
  }

  release(): void {
    if (--this.#holders === 0) this.#recycle(this.frame.buffer);
  }
}
