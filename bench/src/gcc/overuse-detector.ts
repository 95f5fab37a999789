import { AdaptiveThreshold } from './adaptive-threshold.ts';

/** What delay says about the path: queues grow (`over`), drain (`under`), or neither. */
export type BandwidthUsage = 'normal' | 'over' | 'under';

/** Minimum duration of over-use, ms (`overuse_time_th`). */
const OVERUSE_MS = 10;
/** The slope is multiplied by libwebrtc's gain and by the number of groups, up to a maximum. */
const GAIN = 4;
const MOST_GROUPS = 60;

/** Over-use detector (draft-ietf-rmcat-gcc-02, section 5.4). */
export class OveruseDetector {
  usage: BandwidthUsage = 'normal';
  readonly #threshold = new AdaptiveThreshold();
  #overMs = Number.NaN;
  #lastSlope = 0;

  /**
   * @param slope of the delay, see {@link Trendline}
   * @param groups number of groups behind the slope
   * @param sentDeltaMs time that the newest group spans
   */
  update(slope: number, groups: number, sentDeltaMs: number, arrivedMs: number): void {
    if (groups < 2) return;
    const trend = Math.min(groups, MOST_GROUPS) * slope * GAIN;
    const threshold = this.#threshold.value;
    if (trend > threshold) {
      // The threshold was exceeded somewhere within the first group's time.
      const isFirst = Number.isNaN(this.#overMs);
      this.#overMs = isFirst ? sentDeltaMs / 2 : this.#overMs + sentDeltaMs;
      // A queue that grows more slowly than before is not over-use.
      if (!isFirst && this.#overMs > OVERUSE_MS && slope >= this.#lastSlope) {
        this.#overMs = 0;
        this.usage = 'over';
      }
    } else {
      this.#overMs = Number.NaN;
      this.usage = trend < -threshold ? 'under' : 'normal';
    }
    this.#lastSlope = slope;
    this.#threshold.update(Math.abs(trend), arrivedMs);
  }
}
