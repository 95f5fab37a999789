import { BitRate } from '@farpoint/timing';

/** Rates of the first two trains as multiples of the initial rate; of later ones as multiples of the rate found. */
const FIRST_FACTOR = 3;
const SECOND_FACTOR = 6;
const LATER_FACTOR = 2;
/** A train that finds at least this share of its own rate is followed by another one. */
const GO_ON = 0.7;
/** The search ends if a train has not been answered for this long, ms. */
const PATIENCE_MS = 1000;
const TRAIN_MS = 15;
const TRAIN_BYTES = 6000;
/** A train that arrives at less than this share of its sending rate has found the path's rate … */
const UNLIMITED = 0.9;
/** … of which this share is then used. */
const KEEP = 0.95;

/**
 * The search for the path's rate at the start, with trains of packets: at three and six times the initial rate, then
 * at twice the rate found, until a train finds less than 70 % of its own rate. The draft has no probes; libwebrtc
 * starts this way.
 */
export class StartProbes {
  readonly #secondRate: number;
  #nextRate: number;
  #rate = 0;
  #trains = 0;
  #askedMs = Number.NaN;

  constructor(startBitsPerSecond: number) {
    this.#nextRate = FIRST_FACTOR * startBitsPerSecond;
    this.#secondRate = SECOND_FACTOR * startBitsPerSecond;
  }

  /** @returns the rate of the train that is due, bit/s; 0 for none */
  due(mostBitsPerSecond: number, nowMs: number): number {
    if (nowMs - this.#askedMs > PATIENCE_MS) this.#nextRate = 0;
    if (this.#nextRate === 0) return 0;
    this.#rate = Math.min(this.#nextRate, mostBitsPerSecond);
    this.#nextRate = 0;
    this.#trains++;
    this.#askedMs = nowMs;
    return this.#rate;
  }

  /** Length of a train, bytes. */
  static bytes(bitsPerSecond: number): number {
    return Math.max(BitRate.bytesIn(bitsPerSecond, TRAIN_MS), TRAIN_BYTES);
  }

  /** @returns the rate that the train has shown, bit/s */
  onOutcome(sentBitsPerSecond: number, arrivedBitsPerSecond: number): number {
    const isLimited = arrivedBitsPerSecond < UNLIMITED * sentBitsPerSecond;
    const found = isLimited ? KEEP * arrivedBitsPerSecond : Math.min(sentBitsPerSecond, arrivedBitsPerSecond);
    const second = this.#trains === 1 ? this.#secondRate : 0;
    this.#nextRate = Math.max(found > GO_ON * this.#rate ? LATER_FACTOR * found : 0, second);
    return found;
  }
}
