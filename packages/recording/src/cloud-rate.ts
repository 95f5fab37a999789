/** A cloud may be early by this fraction of the interval. */
const EARLY_SHARE = 0.25;

/** Decides which of a camera's clouds are recorded: at most this many per second, evenly spaced. */
export class CloudRate {
  readonly #intervalMs: number;
  #nextMs = Number.NEGATIVE_INFINITY;
  #latestMs: number | null = null;
  #latestTaken = false;

  /** @param perSecond 0 records none */
  constructor(perSecond: number) {
    this.#intervalMs = 1000 / perSecond;
  }

  /** Whether the cloud with this time is recorded. Asking twice for the same time gives the same answer. */
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
