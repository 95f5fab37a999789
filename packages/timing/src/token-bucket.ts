/** Credit is counted in thousandths of a token, so that integer rates and integer milliseconds add up exactly. */
const TOKEN = 1000;

export interface TokenBucketOptions {
  /** Tokens per second, on average. */
  readonly perSecond: number;
  /** Tokens that can be taken at once after a pause. Default: one second's worth. */
  readonly burst?: number;
}

/**
 * A token bucket, initially full: `perSecond` tokens per second on average, up to `burst` at once. Time is an argument.
 */
export class TokenBucket {
  readonly #perSecond: number;
  readonly #capacity: number;
  #credit: number;
  #filledMs: number | null = null;

  constructor({ perSecond, burst = perSecond }: TokenBucketOptions) {
    this.#perSecond = perSecond;
    this.#capacity = burst * TOKEN;
    this.#credit = this.#capacity;
  }

  /**
   * @param tokens how many to take at once: all or none
   * @returns false if there are too few; nothing is taken then
   */
  take(nowMs: number, tokens = 1): boolean {
    // A clock that stands still or runs backwards adds nothing.
    if (this.#filledMs === null) {
      this.#filledMs = nowMs;
    } else if (nowMs > this.#filledMs) {
      this.#credit = Math.min(this.#credit + (nowMs - this.#filledMs) * this.#perSecond, this.#capacity);
      this.#filledMs = nowMs;
    }
    if (this.#credit < tokens * TOKEN) return false;
    this.#credit -= tokens * TOKEN;
    return true;
  }
}
