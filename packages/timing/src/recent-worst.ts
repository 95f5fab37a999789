/** Each value counts for one to two such intervals. */
const INTERVAL_MS = 500;

/** The greatest of the values of the last second or so, without keeping them. */
export class RecentWorst {
  #intervalMs = Number.NEGATIVE_INFINITY;
  #worst = 0;
  #before = 0;

  /** Forgets all. */
  reset(nowMs: number): void {
    this.#intervalMs = nowMs;
    this.#worst = 0;
    this.#before = 0;
  }

  add(value: number, nowMs: number): void {
    this.#turn(nowMs);
    this.#worst = Math.max(this.#worst, value);
  }

  /** 0 if there was none. */
  at(nowMs: number): number {
    this.#turn(nowMs);
    return Math.max(this.#worst, this.#before);
  }

  #turn(nowMs: number): void {
    const intervals = Math.floor((nowMs - this.#intervalMs) / INTERVAL_MS);
    if (intervals < 1) return;
    this.#before = intervals === 1 ? this.#worst : 0;
    this.#worst = 0;
    this.#intervalMs = Number.isFinite(intervals) ? this.#intervalMs + intervals * INTERVAL_MS : nowMs;
  }
}
