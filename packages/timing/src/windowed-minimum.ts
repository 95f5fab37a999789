/** The minimum of the samples of the last `windowMs`, which expire in `BUCKETS` steps of time. */
export class WindowedMinimum {
  static readonly #BUCKETS = 10;
  readonly #bucketMs: number;
  readonly #least = new Float64Array(WindowedMinimum.#BUCKETS).fill(Number.POSITIVE_INFINITY);
  #bucket = Number.NEGATIVE_INFINITY;

  constructor(windowMs: number) {
    this.#bucketMs = windowMs / WindowedMinimum.#BUCKETS;
  }

  add(value: number, nowMs: number): void {
    const bucket = Math.floor(nowMs / this.#bucketMs);
    const steps = Math.min(bucket - this.#bucket, WindowedMinimum.#BUCKETS);
    for (let i = 0; i < steps; i++) this.#least[this.#at(bucket - i)] = Number.POSITIVE_INFINITY;
    if (steps > 0) this.#bucket = bucket;
    const at = this.#at(this.#bucket);
    if (value < (this.#least[at] as number)) this.#least[at] = value;
  }

  /** Infinity before the first sample. */
  get value(): number {
    let least = Number.POSITIVE_INFINITY;
    for (const value of this.#least) if (value < least) least = value;
    return least;
  }

  reset(): void {
    this.#least.fill(Number.POSITIVE_INFINITY);
  }

  #at(bucket: number): number {
    const n = WindowedMinimum.#BUCKETS;
    return ((bucket % n) + n) % n;
  }
}
