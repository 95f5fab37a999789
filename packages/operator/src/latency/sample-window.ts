/** The last samples of a quantity and their distribution. Adding allocates nothing. */
export interface Distribution {
  p50: number;
  p95: number;
  p99: number;
  max: number;
}

export class SampleWindow {
  readonly #samples: Float64Array;
  #count = 0;

  /** @param size how many samples are kept */
  constructor(size: number) {
    this.#samples = new Float64Array(size);
  }

  /** Samples kept. */
  get length(): number {
    return Math.min(this.#count, this.#samples.length);
  }

  add(value: number): void {
    this.#samples[this.#count++ % this.#samples.length] = value;
  }

  clear(): void {
    this.#count = 0;
  }

  /** By nearest rank; `null` without samples. */
  distribution(): Distribution | null {
    if (this.length === 0) return null;
    const sorted = this.#samples.slice(0, this.length).sort();
    const rank = (share: number): number =>
      sorted[Math.max(0, Math.ceil(share * sorted.length) - 1)] as number;
    return { p50: rank(0.5), p95: rank(0.95), p99: rank(0.99), max: sorted.at(-1) as number };
  }
}
