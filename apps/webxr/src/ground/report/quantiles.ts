/** Quantiles of any number of samples in a fixed amount of memory: a histogram with bins in geometric steps. Pure. */

/** What is known of a quantity's samples, in the quantity's unit. */
export interface Summary {
  readonly count: number;
  readonly mean: number;
  readonly p50: number;
  readonly p95: number;
  readonly max: number;
}

/** Each bin is so much wider than the one before: a quantile is off by 1 % at most. Chosen: closer than any of them is measured. */
const STEP = 1.02;
/** Smaller samples are in the first bin, and larger ones in the last. */
const LEAST = 0.01;
const MOST = 1e8;
const BINS = 2 + Math.ceil(Math.log(MOST / LEAST) / Math.log(STEP));

export class Quantiles {
  readonly #bins = new Uint32Array(BINS);
  #count = 0;
  #sum = 0;
  #min = Number.POSITIVE_INFINITY;
  #max = Number.NEGATIVE_INFINITY;

  /** Adding allocates nothing. @param value is ignored if it is no finite number */
  add(value: number): void {
    if (!Number.isFinite(value)) return;
    const bin = value <= LEAST ? 0 : 1 + Math.floor(Math.log(value / LEAST) / Math.log(STEP));
    const index = Math.min(bin, BINS - 1);
    this.#bins[index] = (this.#bins[index] ?? 0) + 1;
    this.#count++;
    this.#sum += value;
    this.#min = Math.min(this.#min, value);
    this.#max = Math.max(this.#max, value);
  }

  /** `null` without samples. */
  summary(): Summary | null {
    if (this.#count === 0) return null;
    return {
      count: this.#count,
      mean: this.#sum / this.#count,
      p50: this.#quantile(0.5),
      p95: this.#quantile(0.95),
      max: this.#max,
    };
  }

  /** By nearest rank. */
  #quantile(share: number): number {
    let left = Math.ceil(share * this.#count);
    let bin = 0;
    while (bin < BINS - 1) {
      left -= this.#bins[bin] ?? 0;
      if (left <= 0) break;
      bin++;
    }
    const middle = bin === 0 ? this.#min : LEAST * STEP ** (bin - 0.5);
    return Math.min(Math.max(middle, this.#min), this.#max);
  }
}
