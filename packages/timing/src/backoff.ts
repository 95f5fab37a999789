export interface BackoffOptions {
  readonly firstMs: number;
  readonly mostMs: number;
  /** Uniform in [0, 1): keeps many peers from reconnecting at the same moment. */
  readonly random: () => number;
}

/** Exponential backoff between attempts, without end: doubles from `firstMs` to `mostMs`, spread by ±25 %. */
export class Backoff {
  readonly #options: BackoffOptions;
  #stepMs: number;

  constructor(options: BackoffOptions) {
    this.#options = options;
    this.#stepMs = options.firstMs;
  }

  /** Call after a failure. @returns the time to wait, ms */
  nextMs(): number {
    const stepMs = this.#stepMs;
    this.#stepMs = Math.min(stepMs * 2, this.#options.mostMs);
    return stepMs * (0.75 + this.#options.random() * 0.5);
  }

  /** Call after success: the next wait is short again. */
  reset(): void {
    this.#stepMs = this.#options.firstMs;
  }
}
