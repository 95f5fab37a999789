/** Weight of the newest sample: a smoothing factor of 0.95. */
const WEIGHT = 0.05;
/**
 * Bounds of the samples' variance over their mean, kbit/s, as in libwebrtc, because a few samples do not show the
 * spread.
 */
const LEAST_SPREAD = 0.4;
const MOST_SPREAD = 2.5;

/**
 * Mean and spread of the incoming rate when the path was full (draft-ietf-rmcat-gcc-02, section 5.5). While the
 * incoming rate is within three standard deviations of it, the sender is near convergence. No rate is far from an
 * unknown capacity.
 */
export class LinkCapacity {
  /** Bit/s; NaN if unknown. */
  estimate = Number.NaN;
  #spread = LEAST_SPREAD;

  get isKnown(): boolean {
    return !Number.isNaN(this.estimate);
  }

  isFarBelow(bitsPerSecond: number): boolean {
    return bitsPerSecond > this.estimate + this.#marginBits;
  }

  isFarAbove(bitsPerSecond: number): boolean {
    return bitsPerSecond < this.estimate - this.#marginBits;
  }

  /** Records that the path was full at this rate. */
  add(bitsPerSecond: number): void {
    this.estimate = this.isKnown ? this.estimate + WEIGHT * (bitsPerSecond - this.estimate) : bitsPerSecond;
    const errorKbit = (bitsPerSecond - this.estimate) / 1000;
    const sample = errorKbit ** 2 / Math.max(this.estimate / 1000, 1);
    const spread = this.#spread + WEIGHT * (sample - this.#spread);
    this.#spread = Math.min(Math.max(spread, LEAST_SPREAD), MOST_SPREAD);
  }

  reset(): void {
    this.estimate = Number.NaN;
  }

  /** Three standard deviations, bit/s. */
  get #marginBits(): number {
    return 3000 * Math.sqrt((this.#spread * this.estimate) / 1000);
  }
}
