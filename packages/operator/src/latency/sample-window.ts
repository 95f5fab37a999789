/** How the samples of a quantity are distributed, in the quantity's unit. */
export interface Distribution {
  /** Median. */
  p50: number;
  /** 95th percentile. */
  p95: number;
  /** 99th percentile. */
  p99: number;
  /** Largest sample. */
  max: number;
}

/** The last samples of a quantity and their distribution. Adding allocates nothing. */
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

  /** Adds a sample, in place of the oldest if the window is full. */
  add(value: number): void {
    this.#samples[this.#count++ % this.#samples.length] = value;
  }

  /** Forgets all samples. */
  clear(): void {
    this.#count = 0;
  }

  /** Percentiles by nearest rank; `null` without samples. */
  distribution(): Distribution | null {
    return distributionOf(this.#samples.slice(0, this.length));
  }
}

/** Percentiles by nearest rank; `null` without samples. @param samples are sorted by this */
export function distributionOf(samples: Float64Array): Distribution | null {
  if (samples.length === 0) return null;
  const sorted = samples.sort();
  const rank = (share: number): number => sorted[Math.max(0, Math.ceil(share * sorted.length) - 1)] as number;
  return { p50: rank(0.5), p95: rank(0.95), p99: rank(0.99), max: sorted.at(-1) as number };
}
