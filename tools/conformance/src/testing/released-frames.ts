/**
 * How the reference system's released bridge turns packets into messages. A frame is sent when a packet with another
 * number arrives. Its points are in the order of its packets, as many as packets times 150 but no more than the frame
 * has. Blocks that are not full are left out. Late and duplicated packets count for the present frame. The header is
 * cut off at byte 20 without being parsed. The first frame, if it is not number 0, is preceded by an empty message.
 * Bytes and time are arguments.
 */
import { encodeBandwidth } from '@farpoint/protocol';

export interface ReleasedFrameEvents {
  /**
   * Called before each frame: the rate at which it was received since the previous frame, bit/s, for the `bandwidth`
   * channel.
   */
  onReport(report: Uint8Array): void;
  onFrame(frame: Uint8Array): void;
}

const RTP_HEADER_BYTES = 20;
const HEADER_BYTES = 16;
const BLOCK_POINTS = 150;
const BLOCK_BYTES = 1200;
const LEAST_BITS_PER_SECOND = 3779;

export class ReleasedFrames {
  readonly #events: ReleasedFrameEvents;
  #number = 0;
  #total = 0;
  #blocks: Uint8Array[] = [];
  #packets = 0;
  #beganMs = 0;
  #swallowNext = false;

  constructor(events: ReleasedFrameEvents) {
    this.#events = events;
  }

  /** @param shown whether its robot is the selected one: the first packet after a switch is swallowed */
  accept(packet: Uint8Array, shown: boolean, nowMs: number): void {
    if (!shown || this.#swallowNext) {
      this.#swallowNext = !shown;
      return;
    }
    // Shorter ones would be read together with the buffer's previous content.
    const padded = new Uint8Array(RTP_HEADER_BYTES + HEADER_BYTES + BLOCK_BYTES);
    padded.set(packet.subarray(0, padded.length));
    const view = new DataView(padded.buffer);
    const number = view.getUint32(20, true);
    if (this.#total === 0) this.#total = view.getUint32(24, true);
    if (number !== this.#number) {
      this.#giveOut(nowMs);
      this.#number = number;
      this.#total = view.getUint32(24, true);
      this.#blocks = [];
      this.#packets = 0;
      this.#beganMs = nowMs;
    }
    this.#packets++;
    if (view.getUint32(32, true) === BLOCK_BYTES)
      this.#blocks.push(padded.subarray(RTP_HEADER_BYTES + HEADER_BYTES));
  }

  #giveOut(nowMs: number): void {
    const bytes = this.#blocks.length * BLOCK_BYTES;
    const seconds = Math.max(nowMs - this.#beganMs, 0.001) / 1000;
    this.#events.onReport(encodeBandwidth(Math.max((bytes * 8) / seconds, LEAST_BITS_PER_SECOND)));
    const points = Math.min(this.#packets * BLOCK_POINTS, Math.floor(this.#total / 8));
    // Where blocks were left out, the rest is whatever the memory contained: zeros here.
    const frame = new Uint8Array(8 * points);
    const coordinates = Buffer.concat(this.#blocks.map((block) => block.subarray(0, 900)));
    const colours = Buffer.concat(this.#blocks.map((block) => block.subarray(900, 1200)));
    frame.set(coordinates.subarray(0, 6 * points));
    frame.set(colours.subarray(0, 2 * points), 6 * points);
    this.#events.onFrame(frame);
  }
}
