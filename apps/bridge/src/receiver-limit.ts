/**
 * What the bridge tells a robot it may send: from loss and the rate received, as the loss-based half of Google's
 * congestion control does (Carlucci et al., 2016, §4.2). Delay is the sender's to judge, by transport-wide feedback.
 */
export interface ReceiverLimitOptions {
  startBitsPerSecond: number;
  maxBitsPerSecond: number;
}

const HIGH_LOSS = 0.1;
const LOW_LOSS = 0.02;
const GROWTH = 1.05;
/** Room above what comes: a robot that sends little says nothing of the path. */
const HEADROOM = 2;

export class ReceiverLimit {
  bitsPerSecond: number;
  readonly #options: ReceiverLimitOptions;

  constructor(options: ReceiverLimitOptions) {
    this.#options = options;
    this.bitsPerSecond = options.startBitsPerSecond;
  }

  /**
   * One frame was received, or what is left of it.
   *
   * @param lossRate share of its points that did not come, 0–1
   * @param receivedBitsPerSecond of late
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
