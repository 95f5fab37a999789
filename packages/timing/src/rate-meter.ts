/** Growth rate of an occasionally sampled total, over a window of about a second. Time is an argument. */
export class RateMeter {
  readonly #times: number[] = [];
  readonly #sums: number[] = [];
  readonly #windowMs: number;

  constructor(windowMs = 1000) {
    this.#windowMs = windowMs;
  }

  update(sum: number, nowMs: number): void {
    this.#times.push(nowMs);
    this.#sums.push(sum);
    // Keep one sample at or before the start of the window, so that the whole window is covered.
    while (this.#times.length > 2 && nowMs - (this.#times[1] as number) >= this.#windowMs) {
      this.#times.shift();
      this.#sums.shift();
    }
  }

  /** Growth per second; 0 before two updates, and if the total has fallen. */
  get perSecond(): number {
    const elapsedMs = (this.#times.at(-1) ?? 0) - (this.#times[0] ?? 0);
    if (elapsedMs <= 0) return 0;
    return (Math.max(0, (this.#sums.at(-1) ?? 0) - (this.#sums[0] ?? 0)) * 1000) / elapsedMs;
  }

  reset(): void {
    this.#times.length = 0;
    this.#sums.length = 0;
  }
}
