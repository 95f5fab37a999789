/** How much a growing sum grows a second, over the last second or so. */
export class RateMeter {
  readonly #times: number[] = [];
  readonly #sums: number[] = [];
  readonly #windowMs: number;

  constructor(windowMs = 1000) {
    this.#windowMs = windowMs;
  }

  /** @param sum never falls, except at {@link reset} */
  update(sum: number, nowMs: number): void {
    this.#times.push(nowMs);
    this.#sums.push(sum);
    while (this.#times.length > 2 && nowMs - (this.#times[1] as number) >= this.#windowMs) {
      this.#times.shift();
      this.#sums.shift();
    }
  }

  /** Per second; 0 before two updates. */
  get perSecond(): number {
    const elapsed = (this.#times.at(-1) ?? 0) - (this.#times[0] ?? 0);
    return elapsed <= 0 ? 0 : (((this.#sums.at(-1) ?? 0) - (this.#sums[0] ?? 0)) * 1000) / elapsed;
  }

  reset(): void {
    this.#times.length = 0;
    this.#sums.length = 0;
  }
}
