/** How long to wait before the next attempt: doubles from `firstMs` to `mostMs`, spread by ±25 %, for ever. */
export class Backoff {
  readonly #firstMs: number;
  readonly #mostMs: number;
  readonly #random: () => number;
  #failures = 0;

  /** @param random uniform in [0, 1): keeps many pages from coming back in step */
  constructor(firstMs: number, mostMs: number, random: () => number) {
    this.#firstMs = firstMs;
    this.#mostMs = mostMs;
    this.#random = random;
  }

  get failures(): number {
    return this.#failures;
  }

  /** Counts one failure. @returns ms to wait */
  next(): number {
    const base = Math.min(this.#firstMs * 2 ** Math.min(this.#failures, 30), this.#mostMs);
    this.#failures++;
    return base * (0.75 + this.#random() * 0.5);
  }

  reset(): void {
    this.#failures = 0;
  }
}
