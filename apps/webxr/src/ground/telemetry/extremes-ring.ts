/** The smallest and largest value of each second of the last hour, for windows that the samples themselves do not fill. */

const SECOND_MS = 1000;
/** The time that two extremes stand for, ms. */
export const EXTREMES_MS = SECOND_MS;
/** A little more than an hour, so that the window's first second is whole. */
const SECONDS_KEPT = 3700;

export class ExtremesRing {
  #seconds = new Float64Array(0);
  #least = new Float64Array(0);
  #most = new Float64Array(0);
  #newest = Number.NEGATIVE_INFINITY;

  add(timeMs: number, value: number): void {
    // Allocated with the first sample: many quantities have none.
    if (this.#seconds.length === 0) {
      this.#seconds = new Float64Array(SECONDS_KEPT).fill(Number.NaN);
      this.#least = new Float64Array(SECONDS_KEPT);
      this.#most = new Float64Array(SECONDS_KEPT);
    }
    const second = Math.floor(timeMs / SECOND_MS);
    if (second <= this.#newest - SECONDS_KEPT) return;
    this.#newest = Math.max(this.#newest, second);
    const slot = second % SECONDS_KEPT;
    if (this.#seconds[slot] !== second) {
      this.#seconds[slot] = second;
      this.#least[slot] = value;
      this.#most[slot] = value;
      return;
    }
    if (value < (this.#least[slot] as number)) this.#least[slot] = value;
    if (value > (this.#most[slot] as number)) this.#most[slot] = value;
  }

  /** Calls `each` for every second within the window that has samples, the oldest first. */
  forEach(fromMs: number, toMs: number, each: (timeMs: number, least: number, most: number) => void): void {
    if (this.#seconds.length === 0) return;
    const first = Math.max(Math.floor(fromMs / SECOND_MS), this.#newest - SECONDS_KEPT + 1, 0);
    const last = Math.min(Math.floor(toMs / SECOND_MS), this.#newest);
    for (let second = first; second <= last; second++) {
      const slot = second % SECONDS_KEPT;
      if (this.#seconds[slot] !== second) continue;
      each(second * SECOND_MS, this.#least[slot] as number, this.#most[slot] as number);
    }
  }

  clear(): void {
    this.#seconds.fill(Number.NaN);
    this.#newest = Number.NEGATIVE_INFINITY;
  }
}
