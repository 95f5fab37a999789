export interface BackoffOptions {
  readonly firstMs: number;
  readonly mostMs: number;
  /** Uniform in [0, 1): prevents many peers from reconnecting at the same time. */
  readonly random: () => number;
}

/** How long to wait before the next attempt: doubles from `firstMs` to `mostMs`, randomised by ±25 %, without end. */
export class Backoff {
  readonly #options: BackoffOptions;
  #stepMs: number;

  constructor(options: BackoffOptions) {
    this.#options = options;
    this.#stepMs = options.firstMs;
  }

  /** Call after a failure. @returns ms to wait */
  nextMs(): number {
    const stepMs = this.#stepMs;
    this.#stepMs = Math.min(stepMs * 2, this.#options.mostMs);
    return stepMs * (0.75 + this.#options.random() * 0.5);
  }

  /** Call after a success: the next wait is short again. */
  reset(): void {
    this.#stepMs = this.#options.firstMs;
  }
}
