/** How much a sum that is sampled now and then grows a second, over the last second or so. Time is an argument. */
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
    // One sample at or before the window's beginning is kept, so that it is covered whole.
    while (this.#times.length > 2 && nowMs - (this.#times[1] as number) >= this.#windowMs) {
      this.#times.shift();
      this.#sums.shift();
    }
  }

  /** Per second; 0 before two updates, and where the sum fell. */
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
