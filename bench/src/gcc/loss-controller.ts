/** Share of packets lost since the last report: the rate grows below LOW and falls above HIGH. */
const LOW = 0.02;
const HIGH = 0.1;
const GROWTH = 1.05;
/** Minimum number of packets for a loss share. If fewer were sent and some lost, they are added to the next report. */
const LEAST_PACKETS = 20;

/** Loss-based control (draft-ietf-rmcat-gcc-02, section 6). Each feedback message counts as a report. */
export class LossController {
  /** `As_hat`, bit/s. */
  estimate: number;
  /** Loss share of the last report, 0–1. */
  fraction = 0;
  readonly #least: number;
  #packets = 0;
  #lost = 0;

  constructor(startBitsPerSecond: number, leastBitsPerSecond: number) {
    this.estimate = startBitsPerSecond;
    this.#least = leastBitsPerSecond;
  }

  /**
   * @param packets number of packets that the report covers, including lost ones
   * @param delayBased the delay-based rate, bit/s; never exceeded, because a rate that is not sent is not tested
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

  /** Raises the rate to what a probe has shown to get through, bit/s. */
  raise(bitsPerSecond: number): void {
    this.estimate = Math.max(this.estimate, bitsPerSecond);
  }
}
