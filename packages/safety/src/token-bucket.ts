/** One second's worth at once after a pause. */
const CAPACITY_MS = 1000;

/** A token bucket: on average `perSecond` takes a second. It is counted in milliseconds of credit, which add up exactly. */
export class TokenBucket {
  readonly #costMs: number;
  #creditMs = CAPACITY_MS;
  #filledMs: number | null = null;

  constructor(perSecond: number) {
    this.#costMs = 1000 / perSecond;
  }

  /** @returns false where the bucket is empty; nothing is taken then */
  take(nowMs: number): boolean {
    // A clock that stands or runs backwards fills nothing.
    if (this.#filledMs === null) {
      this.#filledMs = nowMs;
    } else if (nowMs > this.#filledMs) {
      this.#creditMs = Math.min(this.#creditMs + nowMs - this.#filledMs, CAPACITY_MS);
      this.#filledMs = nowMs;
    }
    if (this.#creditMs < this.#costMs) return false;
    this.#creditMs -= this.#costMs;
    return true;
  }
}
