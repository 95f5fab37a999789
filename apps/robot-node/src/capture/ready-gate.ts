/** How much earlier than planned a cloud may come, as a share of the interval. */
const EARLY_SHARE = 0.25;

/**
 * Decides which clouds to take from a source that sets its own frame rate: as many as planned, evenly spaced. Times
 * in ms.
 */
export class ReadyGate {
  #nextMs: number;
  #plannedMs: number;

  /** @param plannedMs interval between two frames, until the first plan */
  constructor(nowMs: number, plannedMs: number) {
    this.#nextMs = nowMs;
    this.#plannedMs = plannedMs;
  }

  /** A camera's timing jitters: a cloud that is slightly early is not a surplus one. */
  takes(nowMs: number): boolean {
    return nowMs >= this.#nextMs - this.#plannedMs * EARLY_SHARE;
  }

  /** @param intervalMs planned time until the next frame */
  taken(nowMs: number, intervalMs: number): void {
    this.#plannedMs = intervalMs;
    this.#nextMs = Math.max(this.#nextMs + intervalMs, nowMs);
  }
}
