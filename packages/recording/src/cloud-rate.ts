/** A cloud may be so much of its interval early. */
const EARLY_SHARE = 0.25;

/** Which of a camera's clouds are recorded: so many a second at most, evenly. */
export class CloudRate {
  readonly #intervalMs: number;
  #nextMs = Number.NEGATIVE_INFINITY;
  #latestMs: number | null = null;
  #latestTaken = false;

  /** @param perSecond 0: none */
  constructor(perSecond: number) {
    this.#intervalMs = 1000 / perSecond;
  }

  /** Whether the cloud of that time is recorded; asked twice of one, the answer is the same. */
  takes(capturedAtMs: number): boolean {
    if (capturedAtMs !== this.#latestMs) {
      this.#latestMs = capturedAtMs;
      this.#latestTaken = this.#decide(capturedAtMs);
    }
    return this.#latestTaken;
  }

  #decide(capturedAtMs: number): boolean {
    if (this.#intervalMs === Number.POSITIVE_INFINITY) return false;
    if (capturedAtMs < this.#nextMs - this.#intervalMs * EARLY_SHARE) return false;
    const late = capturedAtMs - this.#nextMs > this.#intervalMs;
    this.#nextMs = (late ? capturedAtMs : this.#nextMs) + this.#intervalMs;
    return true;
  }
}
