/** Width of a bin, ms, and their number. Chosen: finer than any timer, up to 100 ms, in 8 kB. */
const STEP_MS = 0.05;
const BINS = 2000;

/** Histogram of lateness, in steps of 0.05 ms up to 100 ms. */
export class LatenessHistogram {
  readonly #counts = new Uint32Array(BINS);
  count = 0;
  maxMs = 0;

  add(ms: number): void {
    this.#counts[Math.min(BINS - 1, Math.max(0, Math.floor(ms / STEP_MS)))]!++;
    this.count++;
    if (ms > this.maxMs) this.maxMs = ms;
  }

  /** This fraction of the samples was at most this late, rounded up to the next step; 0 without samples. */
  quantile(share: number): number {
    let left = share * this.count;
    for (let bin = 0; bin < BINS; bin++) {
      left -= this.#counts[bin]!;
      if (left <= 0 && this.count > 0) return (bin + 1) * STEP_MS;
    }
    return this.maxMs;
  }

  clear(): void {
    this.#counts.fill(0);
    this.count = this.maxMs = 0;
  }
}
