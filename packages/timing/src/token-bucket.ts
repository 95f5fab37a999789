/** Credit is counted in thousandths of a token, so that integer rates and integer milliseconds add up exactly. */
const TOKEN = 1000;

export interface TokenBucketOptions {
  /** Takes per second, in the long run. */
  readonly perSecond: number;
  /** Takes at once after a pause. Default: as many as in one second. */
  readonly burst?: number;
}

/** A token bucket, initially full. It allows `perSecond` takes on average, `burst` at once. Time is an argument. */
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

  /** @returns false if the bucket is empty; nothing is then taken */
  take(nowMs: number): boolean {
    // A clock that stops or runs backwards adds no credit.
    if (this.#filledMs === null) {
      this.#filledMs = nowMs;
    } else if (nowMs > this.#filledMs) {
      this.#credit = Math.min(this.#credit + (nowMs - this.#filledMs) * this.#perSecond, this.#capacity);
      this.#filledMs = nowMs;
    }
    if (this.#credit < TOKEN) return false;
    this.#credit -= TOKEN;
    return true;
  }
}
