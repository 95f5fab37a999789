/**
 * The rate limit from a reference operator's `bandwidth` reports. The reference system's bridge reports how fast each
 * frame arrived: its points over the time until the next frame began. That is never more than was sent, so a report
 * limits the rate only where it falls short of what was sent. Taken literally, such reports would reduce the rate
 * without end: whenever a frame is smaller than it might have been, because the source is slow or has few points, the
 * next limit would be smaller, too. Their unit is bits of point data, as in the paper's equation 2. Time is an argument.
 */
import { MAX_POINT_DATA_BYTES } from '@farpoint/protocol';
import { BitRate, bitsOfBytes } from '@farpoint/timing';

/** The largest of so many reports counts: a single frame may be small, or late. */
const REPORTS = 16;
/** The first reports cover the connection's own start. */
const LEAST_REPORTS = 4;
/**
 * So many frames tell what was sent. Reports come a round trip later. Therefore the sent rate is that of the older or
 * that of the newer half, whichever is lower: it rises only when there has been time for reports.
 */
const FRAMES = 32;
const LEAST_FRAMES = 5;
/** After such a pause in sending, what was sent before it says nothing about the rate, ms. */
const PAUSE_MS = 2000;
/** Reports that reach this share of what was sent say that the path carried it. */
const CARRIED_SHARE = 0.9;
/** How much a limit rises with each report that says so. */
const GROWTH = 1.02;
/** A limit so much above what is sent limits nothing. */
const IDLE_FACTOR = 4;

export class ReportedLimit {
  readonly #reports = new Float64Array(REPORTS);
  readonly #bits = new Float64Array(FRAMES);
  readonly #sentMs = new Float64Array(FRAMES);
  readonly #wirePerPoint: number;
  #reportCount = 0;
  #frameCount = 0;
  /** Bits of points per second. */
  #limit = Number.POSITIVE_INFINITY;

  /** @param wireBytesPerPacket size of a full packet on the wire, bytes */
  constructor(wireBytesPerPacket: number) {
    this.#wirePerPoint = wireBytesPerPacket / MAX_POINT_DATA_BYTES;
  }

  /** Bit/s on the wire; infinite while the path carries what is sent. */
  get bitsPerSecond(): number {
    return this.#limit * this.#wirePerPoint;
  }

  /** A frame of so many full packets has been sent to its last. */
  sent(packets: number, nowMs: number): void {
    const last = (this.#frameCount + FRAMES - 1) % FRAMES;
    if (this.#frameCount > 0 && nowMs - (this.#sentMs[last] as number) > PAUSE_MS) this.#frameCount = 0;
    this.#bits[this.#frameCount % FRAMES] = bitsOfBytes(packets * MAX_POINT_DATA_BYTES);
    this.#sentMs[this.#frameCount % FRAMES] = nowMs;
    this.#frameCount++;
    this.#judge();
  }

  /** @param bitsPerSecond one report */
  reported(bitsPerSecond: number): void {
    this.#reports[this.#reportCount % REPORTS] = bitsPerSecond;
    this.#reportCount++;
    if (this.#reportCount < LEAST_REPORTS || this.#judge()) return;
    this.#limit = Math.max(this.#limit * GROWTH, this.#largestReport());
    const sent = this.#sentBitsPerSecond();
    if (sent > 0 && this.#limit > sent * IDLE_FACTOR) this.#limit = Number.POSITIVE_INFINITY;
  }

  /** @returns whether the path carries less than is sent. Then what arrives is the limit */
  #judge(): boolean {
    if (this.#reportCount < LEAST_REPORTS || this.#frameCount < LEAST_FRAMES) return false;
    const largest = this.#largestReport();
    if (largest >= this.#sentBitsPerSecond() * CARRIED_SHARE) return false;
    this.#limit = largest;
    return true;
  }

  #largestReport(): number {
    const filled = Math.min(this.#reportCount, REPORTS);
    let largest = 0;
    for (let i = 0; i < filled; i++) largest = Math.max(largest, this.#reports[i] as number);
    return largest;
  }

  /** Bits of points per second; 0 while unknown. */
  #sentBitsPerSecond(): number {
    const filled = Math.min(this.#frameCount, FRAMES);
    const half = Math.floor((filled - 1) / 2);
    return Math.min(this.#sentBetween(0, half), this.#sentBetween(half, filled - 1));
  }

  /** What was sent after one frame up to another, of those that are remembered, counted from the oldest. */
  #sentBetween(from: number, to: number): number {
    const oldest = Math.max(this.#frameCount - FRAMES, 0);
    const at = (index: number) => (oldest + index) % FRAMES;
    let bits = 0;
    for (let i = from + 1; i <= to; i++) bits += this.#bits[at(i)] as number;
    const spanMs = (this.#sentMs[at(to)] as number) - (this.#sentMs[at(from)] as number);
    return spanMs > 0 ? BitRate.ofBits(bits, spanMs) : 0;
  }
}
