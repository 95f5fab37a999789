/** Where the robot has been: a point whenever it has moved noticeably. Bounded; the oldest points are overwritten. */

/** Points that are kept: 800 m. */
const CAPACITY = 16_384;
/** Distance between two points, in the unit of the coordinates times the scale. */
const STEP_M = 0.05;

export class Track {
  readonly #xs: Float64Array;
  readonly #ys: Float64Array;
  readonly #capacity: number;
  readonly #step: number;
  #count = 0;

  /** @param step two points are at least this far apart, in the coordinates' unit */
  constructor(step = STEP_M, capacity = CAPACITY) {
    this.#step = step;
    this.#capacity = capacity;
    this.#xs = new Float64Array(capacity);
    this.#ys = new Float64Array(capacity);
  }

  get length(): number {
    return Math.min(this.#count, this.#capacity);
  }

  add(x: number, y: number): void {
    const { length } = this;
    if (length > 0 && Math.hypot(x - this.xAt(length - 1), y - this.yAt(length - 1)) < this.#step) return;
    const slot = this.#count % this.#capacity;
    this.#xs[slot] = x;
    this.#ys[slot] = y;
    this.#count++;
  }

  /** @param index 0 is the oldest point */
  xAt(index: number): number {
    return this.#xs[this.#slot(index)] as number;
  }

  /** @param index 0 is the oldest point */
  yAt(index: number): number {
    return this.#ys[this.#slot(index)] as number;
  }

  clear(): void {
    this.#count = 0;
  }

  #slot(index: number): number {
    return (Math.max(0, this.#count - this.#capacity) + index) % this.#capacity;
  }
}
