/** A token bucket: on average `perSecond` takes a second, and one second's worth at once after a pause. */
export class TokenBucket {
  readonly #perSecond: number;
  #tokens: number;
  #filledMs: number | null = null;

  constructor(perSecond: number) {
    this.#perSecond = perSecond;
    this.#tokens = perSecond;
  }

  /** @returns false where the bucket is empty; nothing is taken then */
  take(nowMs: number): boolean {
    // A clock that stands or runs backwards fills nothing.
    if (this.#filledMs !== null && nowMs > this.#filledMs) {
      const filled = this.#tokens + ((nowMs - this.#filledMs) / 1000) * this.#perSecond;
      this.#tokens = Math.min(filled, this.#perSecond);
    }
    this.#filledMs = Math.max(nowMs, this.#filledMs ?? nowMs);
    if (this.#tokens < 1) return false;
    this.#tokens -= 1;
    return true;
  }
}
