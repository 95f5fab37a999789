const BUCKET_MS = 500;

/**
 * How late a page's own timer comes, as the longest time between two of its ticks within the last second or so: what keeps
 * it from running keeps it from reading the operator's hand as well. No clock here.
 */
export class WorstGap {
  #tickMs: number | null = null;
  #bucketMs = 0;
  #worst = 0;
  #before = 0;

  /**
   * Call it many times a second.
   *
   * @param nowMs `performance.now()`
   */
  tick(nowMs: number): void {
    this.#turn(nowMs);
    if (this.#tickMs !== null) this.#worst = Math.max(this.#worst, nowMs - this.#tickMs);
    this.#tickMs = nowMs;
  }

  /**
   * The longest, ms.
   *
   * @param nowMs `performance.now()`
   */
  at(nowMs: number): number {
    this.#turn(nowMs);
    return Math.max(this.#worst, this.#before);
  }

  /** The page was hidden: its timers rest. */
  pause(): void {
    this.#tickMs = null;
    this.#worst = 0;
    this.#before = 0;
  }

  #turn(nowMs: number): void {
    const buckets = Math.floor((nowMs - this.#bucketMs) / BUCKET_MS);
    if (buckets < 1) return;
    this.#before = buckets === 1 ? this.#worst : 0;
    this.#worst = 0;
    this.#bucketMs += buckets * BUCKET_MS;
  }
}
