export interface BackoffOptions {
  readonly firstMs: number;
  readonly mostMs: number;
  /** Uniform in [0, 1): keeps many peers from coming back in step. */
  readonly random: () => number;
}

/** How long to wait before the next attempt: doubles from `firstMs` to `mostMs`, spread by ±25 %, for ever. */
export class Backoff {
  readonly #options: BackoffOptions;
  #stepMs: number;

  constructor(options: BackoffOptions) {
    this.#options = options;
    this.#stepMs = options.firstMs;
  }

  /** After a failure. @returns ms to wait */
  nextMs(): number {
    const stepMs = this.#stepMs;
    this.#stepMs = Math.min(stepMs * 2, this.#options.mostMs);
    return stepMs * (0.75 + this.#options.random() * 0.5);
  }

  /** After success: the next wait is short again. */
  reset(): void {
    this.#stepMs = this.#options.firstMs;
  }
}
