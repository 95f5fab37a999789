/** At most so many messages a second; the rhythm is kept where they do not come to the millisecond. */
export class RateLimit {
  #intervalMs: number;
  #nextMs = Number.NEGATIVE_INFINITY;

  /** @param perSecond `null`: as many as come */
  constructor(perSecond: number | null) {
    this.#intervalMs = perSecond === null ? 0 : 1000 / perSecond;
  }

  /** From now on; what was admitted before counts. */
  change(perSecond: number | null): void {
    this.#nextMs -= this.#intervalMs;
    this.#intervalMs = perSecond === null ? 0 : 1000 / perSecond;
    this.#nextMs += this.#intervalMs;
  }

  /** @returns whether the message that comes now is taken */
  admits(nowMs: number): boolean {
    if (this.#intervalMs === 0) return true;
    // One that is a little early is not the one too many.
    if (nowMs < this.#nextMs - this.#intervalMs / 4) return false;
    const rested = nowMs - this.#nextMs > this.#intervalMs;
    this.#nextMs = (rested ? nowMs : this.#nextMs) + this.#intervalMs;
    return true;
  }
}
