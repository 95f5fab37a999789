/**
 * The rate limit that the bridge reports to a robot. It is computed from loss and the received rate, like the
 * loss-based half of Google's congestion control (Carlucci et al., 2016, §4.2). Delay is left to the sender, which
 * has transport-wide feedback.
 */
export interface ReceiverLimitOptions {
  startBitsPerSecond: number;
  maxBitsPerSecond: number;
}

/**
 * Above the first share of lost points the limit falls, below the second it grows by the factor, between them it stays.
 * All three are those of draft-ietf-rmcat-gcc-02, 6; receiver-limit.test.ts holds them.
 */
const HIGH_LOSS = 0.1;
const LOW_LOSS = 0.02;
const GROWTH = 1.05;
/**
 * Factor above the received rate: a robot that sends little does not reveal the path's rate. Chosen: one doubling ahead of
 * what has been proved.
 */
const HEADROOM = 2;

export class ReceiverLimit {
  bitsPerSecond: number;
  readonly #options: ReceiverLimitOptions;

  constructor(options: ReceiverLimitOptions) {
    this.#options = options;
    this.bitsPerSecond = options.startBitsPerSecond;
  }

  /**
   * Takes the statistics of a frame that was received, entirely or in part.
   *
   * @param lossRate share of its points that did not arrive, 0–1
   * @param receivedBitsPerSecond recent rate
   */
  onFrame(lossRate: number, receivedBitsPerSecond: number): number {
    const { startBitsPerSecond, maxBitsPerSecond } = this.#options;
    if (lossRate > HIGH_LOSS) {
      this.bitsPerSecond = Math.max(this.bitsPerSecond * (1 - lossRate / 2), startBitsPerSecond / 10);
    } else if (lossRate < LOW_LOSS) {
      const most = Math.max(HEADROOM * receivedBitsPerSecond, startBitsPerSecond);
      if (this.bitsPerSecond < most) this.bitsPerSecond = Math.min(this.bitsPerSecond * GROWTH, most);
    }
    this.bitsPerSecond = Math.min(this.bitsPerSecond, maxBitsPerSecond);
    return this.bitsPerSecond;
  }
}
