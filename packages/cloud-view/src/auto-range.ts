/**
 * The range of values that a colour map shows, from a few samples of the points received. It follows slowly, so that a
 * colour keeps its meaning from one picture to the next, and leaves outliers out. No clock here; allocates nothing.
 */

/** Samples that are kept: two or three frames of 200 (point-colouring.ts). */
const SAMPLES = 512;
/** With fewer samples there is no range. Chosen: fewer tell of single things. */
const LEAST_SAMPLES = 32;
/**
 * Share of the samples that are left out at either end. Chosen: noise in front of and behind the scene; more
 * would cut real things.
 */
const OUTLIERS = 0.01;
/** The samples are evaluated this often, ms. Chosen: far below the time in which the range follows. */
const INTERVAL_MS = 250;
/**
 * Time constant with which the range follows, ms. Chosen by eye: faster ones make all colours flicker when
 * somebody passes. auto-range.test.ts holds it.
 */
const FOLLOW_MS = 1500;

export class AutoRange {
  min = 0;
  max = 1;
  readonly #samples = new Float32Array(SAMPLES);
  readonly #sorted = new Float32Array(SAMPLES);
  #count = 0;
  #next = 0;
  #evaluatedMs: number | null = null;

  /** Takes a sample. The oldest of {@link SAMPLES} is forgotten. */
  add(value: number): void {
    this.#samples[this.#next] = value;
    this.#next = (this.#next + 1) % SAMPLES;
    this.#count = Math.min(this.#count + 1, SAMPLES);
  }

  /**
   * Call it with every display frame.
   *
   * @param nowMs `performance.now()`
   * @param leastSpan the range is never narrower, so that noise does not take all the colours
   */
  update(nowMs: number, leastSpan: number): void {
    const last = this.#evaluatedMs;
    if (this.#count < LEAST_SAMPLES || (last !== null && nowMs - last < INTERVAL_MS)) return;
    this.#evaluatedMs = nowMs;
    // Empty places sort to the end.
    for (let i = 0; i < SAMPLES; i++) {
      this.#sorted[i] = i < this.#count ? (this.#samples[i] as number) : Number.POSITIVE_INFINITY;
    }
    this.#sorted.sort();
    const left = Math.floor(this.#count * OUTLIERS);
    const low = this.#sorted[left] as number;
    const high = this.#sorted[this.#count - 1 - left] as number;
    const margin = Math.max(0, leastSpan - (high - low)) / 2;
    const share = last === null ? 1 : 1 - Math.exp(-(nowMs - last) / FOLLOW_MS);
    this.min += (low - margin - this.min) * share;
    this.max += (high + margin - this.max) * share;
  }

  /**
   * Forgets the samples: they are of another session or of another quantity. The next range applies at once; until
   * then it is the given one.
   */
  reset(min: number, max: number): void {
    this.min = min;
    this.max = max;
    this.#count = 0;
    this.#next = 0;
    this.#evaluatedMs = null;
  }
}
