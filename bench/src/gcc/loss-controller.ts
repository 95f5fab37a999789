/** Of the packets since the last report: below the first the rate grows, above the second it is cut. */
const LOW = 0.02;
const HIGH = 0.1;
const GROWTH = 1.05;
/** Packets that a fraction is told from. Where some of fewer are lost, they wait for the next report. */
const LEAST_PACKETS = 20;

/** Loss-based control (draft-ietf-rmcat-gcc-02, section 6), with each feedback message as a report. */
export class LossController {
  /** `As_hat`, bit/s. */
  estimate: number;
  /** Of the last report, 0–1. */
  fraction = 0;
  readonly #least: number;
  #packets = 0;
  #lost = 0;

  constructor(startBitsPerSecond: number, leastBitsPerSecond: number) {
    this.estimate = startBitsPerSecond;
    this.#least = leastBitsPerSecond;
  }

  /**
   * @param packets that the report speaks of, lost ones among them
   * @param delayBased what the delay allows, bit/s: never exceeded, for what is not sent is not tried
   */
  onReport(packets: number, lost: number, delayBased: number): void {
    this.#packets += packets;
    this.#lost += lost;
    if (this.#packets >= LEAST_PACKETS || this.#lost === 0) {
      this.fraction = this.#lost / this.#packets;
      this.#packets = 0;
      this.#lost = 0;
      if (this.fraction < LOW) this.estimate *= GROWTH;
      else if (this.fraction > HIGH) this.estimate *= 1 - 0.5 * this.fraction;
    }
    this.estimate = Math.max(Math.min(this.estimate, delayBased), this.#least);
  }

  /** A probe has told that so much gets through, bit/s. */
  raise(bitsPerSecond: number): void {
    this.estimate = Math.max(this.estimate, bitsPerSecond);
  }
}
