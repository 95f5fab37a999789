/**
 * How the reference system's released bridge makes messages of packets: a frame goes out when a packet with another number comes, in the
 * order in which its packets came, as many points as packets times 150 but no more than the frame has; blocks that are not full are left
 * out; what is late or doubled counts for the frame of now; the header is cut off at byte 20 without looking. The first frame that is not
 * number 0 sends an empty message before it. Bytes and time are arguments.
 */
import { encodeBandwidth } from '@farpoint/protocol';

export interface ReleasedFrameEvents {
  /** Before each frame: what was received of it over the time since the one before, bit/s, on the `bandwidth` channel. */
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

  /** @param shown whether its robot is the chosen one: the first packet after it was another is swallowed */
  accept(packet: Uint8Array, shown: boolean, nowMs: number): void {
    if (!shown || this.#swallowNext) {
      this.#swallowNext = !shown;
      return;
    }
    // Shorter ones would be read together with what the buffer held before.
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
    // Where blocks were left out, the rest is whatever the memory held: zeros here.
    const frame = new Uint8Array(8 * points);
    const coordinates = Buffer.concat(this.#blocks.map((block) => block.subarray(0, 900)));
    const colours = Buffer.concat(this.#blocks.map((block) => block.subarray(900, 1200)));
    frame.set(coordinates.subarray(0, 6 * points));
    frame.set(colours.subarray(0, 2 * points), 6 * points);
    this.#events.onFrame(frame);
  }
}
