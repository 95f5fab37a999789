/** Each interval counts for one to two such times. */
const REMEMBERED_MS = 500;

/**
 * The longest interval that is usual: the second longest of the last second or so, or the last one if that was longer.
 * So one delay counts until the next event only, and a lower rate or events in bursts are usual at once.
 */
export class UsualInterval {
  #beganMs = Number.NEGATIVE_INFINITY;
  #last = 0;
  /** The two longest, ms, of the time that is running and of the one before. */
  #longest = 0;
  #second = 0;
  #longestBefore = 0;
  #secondBefore = 0;

  add(intervalMs: number, nowMs: number): void {
    this.#turn(nowMs);
    this.#last = intervalMs;
    if (intervalMs > this.#longest) {
      this.#second = this.#longest;
      this.#longest = intervalMs;
    } else this.#second = Math.max(this.#second, intervalMs);
  }

  /** ms; 0 if there was none. */
  at(nowMs: number): number {
    this.#turn(nowMs);
    const lower = Math.min(this.#longest, this.#longestBefore);
    return Math.max(lower, this.#second, this.#secondBefore, this.#last);
  }

  /** Forgets all. */
  reset(nowMs: number): void {
    this.#clear();
    this.#longestBefore = 0;
    this.#secondBefore = 0;
    this.#beganMs = nowMs;
  }

  #turn(nowMs: number): void {
    const times = Math.floor((nowMs - this.#beganMs) / REMEMBERED_MS);
    if (times < 1) return;
    this.#longestBefore = times === 1 ? this.#longest : 0;
    this.#secondBefore = times === 1 ? this.#second : 0;
    const last = times === 1 ? this.#last : 0;
    this.#clear();
    this.#last = last;
    this.#beganMs = Number.isFinite(times) ? this.#beganMs + times * REMEMBERED_MS : nowMs;
  }

  #clear(): void {
    this.#last = 0;
    this.#longest = 0;
    this.#second = 0;
  }
}
