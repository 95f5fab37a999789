import { RecentWorst } from '@farpoint/timing';

/**
 * How late a page's own timer comes, as the longest time between two of its calls within the last second or so: what keeps
 * it from running keeps it from reading the operator's hand as well. No clock here.
 */
export class WorstGap {
  #calledMs: number | null = null;
  readonly #gaps = new RecentWorst();

  /**
   * Call it many times a second.
   *
   * @param nowMs `performance.now()`
   */
  measure(nowMs: number): void {
    if (this.#calledMs !== null) this.#gaps.add(nowMs - this.#calledMs, nowMs);
    this.#calledMs = nowMs;
  }

  /**
   * The longest, ms.
   *
   * @param nowMs `performance.now()`
   */
  at(nowMs: number): number {
    return this.#gaps.at(nowMs);
  }

  /** The page was hidden: its timers rest. */
  pause(): void {
    if (this.#calledMs !== null) this.#gaps.reset(this.#calledMs);
    this.#calledMs = null;
  }
}
