export interface BackoffOptions {
  firstMs: number;
  maxMs: number;
  /** 0 ≤ value < 1. */
  random: () => number;
}

/** Growing waits between tries, each anywhere from half to the whole of its step, so that many robots do not return at once. */
export class Backoff {
  readonly #options: BackoffOptions;
  #stepMs: number;

  constructor(options: BackoffOptions) {
    this.#options = options;
    this.#stepMs = options.firstMs;
  }

  nextMs(): number {
    const step = this.#stepMs;
    this.#stepMs = Math.min(step * 2, this.#options.maxMs);
    return step * (0.5 + this.#options.random() / 2);
  }

  /** After success: the next wait is short again. */
  reset(): void {
    this.#stepMs = this.#options.firstMs;
  }
}
