/** The newest samples of a number, ordered by time, in memory that is bounded and never copied per sample. */

/** At 50 samples a second, 11 minutes. */
const RING_CAPACITY = 32_768;
const FIRST_CAPACITY = 256;
/** A sample that is overtaken by more others than this is dropped. Chosen: 3 s at 20 a second. */
const MOST_OVERTAKEN = 64;

/** What became of a sample. */
export type RingVerdict = 'added' | 'duplicate' | 'late';

export class SampleRing {
  readonly #most: number;
  #times: Float64Array;
  #values: Float64Array;
  #start = 0;
  #count = 0;

  /** @param most samples that are kept: the oldest are overwritten */
  constructor(most = RING_CAPACITY) {
    this.#most = most;
    const first = Math.min(FIRST_CAPACITY, most);
    this.#times = new Float64Array(first);
    this.#values = new Float64Array(first);
  }

  get length(): number {
    return this.#count;
  }

  /** Whether older samples have been overwritten, or will be by the next one. */
  get isFull(): boolean {
    return this.#count === this.#most;
  }

  /** @param index 0 is the oldest sample */
  timeAt(index: number): number {
    return this.#times[this.#slot(index)] as number;
  }

  /** @param index 0 is the oldest sample */
  valueAt(index: number): number {
    return this.#values[this.#slot(index)] as number;
  }

  /** Samples may be late by a few places; of two with the same time, the first stays. */
  add(timeMs: number, value: number): RingVerdict {
    let at = this.#count;
    const least = Math.max(0, this.#count - MOST_OVERTAKEN);
    while (at > least && this.timeAt(at - 1) > timeMs) at--;
    if (at > 0 && this.timeAt(at - 1) === timeMs) return 'duplicate';
    // Older than everything that is kept, or than what is searched.
    if (at === least && at < this.#count && (least > 0 || this.isFull)) return 'late';
    if (this.isFull) {
      this.#start = this.#slot(1);
      this.#count--;
      at--;
    } else if (this.#count === this.#times.length) this.#grow();
    this.#count++;
    for (let i = this.#count - 1; i > at; i--) this.#put(i, this.timeAt(i - 1), this.valueAt(i - 1));
    this.#put(at, timeMs, value);
    return 'added';
  }

  /** Index of the newest sample that is not newer than this time; −1 if there is none. */
  indexAt(timeMs: number): number {
    let [low, high] = [0, this.#count];
    while (low < high) {
      const middle = (low + high) >>> 1;
      if (this.timeAt(middle) <= timeMs) low = middle + 1;
      else high = middle;
    }
    return low - 1;
  }

  clear(): void {
    this.#start = 0;
    this.#count = 0;
  }

  #slot(index: number): number {
    return (this.#start + index) % this.#times.length;
  }

  #put(index: number, timeMs: number, value: number): void {
    const slot = this.#slot(index);
    this.#times[slot] = timeMs;
    this.#values[slot] = value;
  }

  #grow(): void {
    const length = Math.min(this.#times.length * 2, this.#most);
    const times = new Float64Array(length);
    const values = new Float64Array(length);
    for (let i = 0; i < this.#count; i++) {
      times[i] = this.timeAt(i);
      values[i] = this.valueAt(i);
    }
    this.#times = times;
    this.#values = values;
    this.#start = 0;
  }
}
