/** How much earlier than planned its cloud may be, as a share of the interval. */
const EARLY_SHARE = 0.25;

/** Which clouds of a source with a rhythm of its own are taken: those that the plan has room for, evenly. Times in ms. */
export class ReadyGate {
  #nextMs: number;
  #plannedMs: number;

  /** @param plannedMs between two frames, until the first plan */
  constructor(nowMs: number, plannedMs: number) {
    this.#nextMs = nowMs;
    this.#plannedMs = plannedMs;
  }

  /** A camera's clouds do not come to the millisecond: one that is a little early is not the one too many. */
  takes(nowMs: number): boolean {
    return nowMs >= this.#nextMs - this.#plannedMs * EARLY_SHARE;
  }

  /** @param intervalMs until the next, as planned now */
  taken(nowMs: number, intervalMs: number): void {
    this.#plannedMs = intervalMs;
    this.#nextMs = Math.max(this.#nextMs + intervalMs, nowMs);
  }
}
