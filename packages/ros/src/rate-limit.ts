/** At most so many messages a second; the rhythm is kept where they do not come to the millisecond. */
export class RateLimit {
  readonly #intervalMs: number;
  #nextMs = Number.NEGATIVE_INFINITY;

  constructor(perSecond: number) {
    this.#intervalMs = 1000 / perSecond;
  }

  /** @returns whether the message that comes now is taken */
  admits(nowMs: number): boolean {
    // One that is a little early is not the one too many.
    if (nowMs < this.#nextMs - this.#intervalMs / 4) return false;
    this.#nextMs = Math.max(this.#nextMs + this.#intervalMs, nowMs);
    return true;
  }
}
