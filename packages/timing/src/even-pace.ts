/** How much earlier than it is due something may come, as a share of the interval. */
const EARLY_SHARE = 0.35;

/**
 * Chooses, of what comes at a rate that others set, as much as is wanted, evenly spaced. Times in ms, on one clock.
 *
 * What comes jitters: what is slightly early is not a surplus one. What came late is made up for by at most one: after a
 * pause there is no burst.
 */
export class EvenPace {
  #dueMs: number | null = null;

  /** Whether one is due. The first always is. @param intervalMs as it was last planned */
  takes(nowMs: number, intervalMs: number): boolean {
    return this.#dueMs === null || nowMs >= this.#dueMs - intervalMs * EARLY_SHARE;
  }

  /** It was taken. @param intervalMs planned time until the next one */
  taken(nowMs: number, intervalMs: number): void {
    this.#dueMs = Math.max((this.#dueMs ?? nowMs) + intervalMs, nowMs);
  }

  /** Whatever comes next is due. */
  reset(): void {
    this.#dueMs = null;
  }
}
