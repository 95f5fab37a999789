/**
 * How often a source's clouds really come. The rate that was declared for a source is only the highest it may have: a
 * camera in a dark room, or a producer that shares its computer, gives fewer. Time is an argument.
 */

/** So few that the rate is known soon after it has changed, and so many that jitter hardly matters. */
const INTERVALS = 8;
const LEAST_INTERVALS = 3;
/**
 * Longer intervals count as this one, ms: the lowest rate that is ever measured is 0.5 frames/s. Chosen: a
 * pause is none of the source's rate.
 */
const LONGEST_MS = 2000;

export class SourceRate {
  readonly #intervals = new Float64Array(INTERVALS);
  #count = 0;
  #lastMs: number | null = null;
  #perSecond: number | null = null;

  /** Clouds per second, of late; `null` while too few have come. */
  get perSecond(): number | null {
    return this.#perSecond;
  }

  /** A cloud is there, whether or not it is taken. */
  came(nowMs: number): void {
    const lastMs = this.#lastMs;
    this.#lastMs = nowMs;
    if (lastMs === null) return;
    this.#intervals[this.#count % INTERVALS] = Math.min(nowMs - lastMs, LONGEST_MS);
    this.#count++;
    if (this.#count < LEAST_INTERVALS) return;
    const meanMs = this.#meanMs();
    this.#perSecond = meanMs > 0 ? 1000 / meanMs : null;
  }

  /**
   * The longest interval counts as the second longest. Otherwise a single pause, such as the time in which nobody
   * watched, would make the source appear slow, and the frames after it too large for the link.
   */
  #meanMs(): number {
    const filled = Math.min(this.#count, INTERVALS);
    let sum = 0;
    let longest = 0;
    let second = 0;
    for (let i = 0; i < filled; i++) {
      const interval = this.#intervals[i] as number;
      sum += interval;
      if (interval > longest) {
        second = longest;
        longest = interval;
      } else if (interval > second) second = interval;
    }
    return (sum - longest + second) / filled;
  }
}
