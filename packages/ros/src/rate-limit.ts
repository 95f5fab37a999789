/** Admits at most this many messages per second, evenly, even if they do not arrive on the exact millisecond. */
export class RateLimit {
  #intervalMs: number;
  #nextMs = Number.NEGATIVE_INFINITY;

  /** @param perSecond `null` for no limit */
  constructor(perSecond: number | null) {
    this.#intervalMs = perSecond === null ? 0 : 1000 / perSecond;
  }

  /** Applies from now on, counting the messages admitted before. */
  change(perSecond: number | null): void {
    this.#nextMs -= this.#intervalMs;
    this.#intervalMs = perSecond === null ? 0 : 1000 / perSecond;
    this.#nextMs += this.#intervalMs;
  }

  /** @returns whether the message that arrives now is admitted */
  admits(nowMs: number): boolean {
    if (this.#intervalMs === 0) return true;
    // A message that is slightly early is not one too many.
    if (nowMs < this.#nextMs - this.#intervalMs / 4) return false;
    const rested = nowMs - this.#nextMs > this.#intervalMs;
    this.#nextMs = (rested ? nowMs : this.#nextMs) + this.#intervalMs;
    return true;
  }
}
