/** A number over time: its samples, how often they come, and its curve for a chart. No clock here: times are arguments. */
import type { Curve } from './curve.ts';
import { type RingVerdict, SampleRing } from './sample-ring.ts';

/** Each second of a curve is summed up once. */
const SECOND_MS = 1000;
/** The time that two extremes stand for, ms. */
const EXTREMES_MS = SECOND_MS;
/** A little more than an hour, so that the window's first second is whole. */
const SECONDS_KEPT = 3700;

/** The smallest and largest value of each second of the last hour, for windows that the samples themselves do not fill. */
class ExtremesRing {
  #seconds = new Float64Array(0);
  #least = new Float64Array(0);
  #most = new Float64Array(0);
  #newest = Number.NEGATIVE_INFINITY;

  add(timeMs: number, value: number): void {
    // Allocated with the first sample: many quantities have none.
    if (this.#seconds.length === 0) {
      this.#seconds = new Float64Array(SECONDS_KEPT).fill(Number.NaN);
      this.#least = new Float64Array(SECONDS_KEPT);
      this.#most = new Float64Array(SECONDS_KEPT);
    }
    const second = Math.floor(timeMs / SECOND_MS);
    if (second <= this.#newest - SECONDS_KEPT) return;
    this.#newest = Math.max(this.#newest, second);
    const slot = second % SECONDS_KEPT;
    if (this.#seconds[slot] !== second) {
      this.#seconds[slot] = second;
      this.#least[slot] = value;
      this.#most[slot] = value;
      return;
    }
    if (value < (this.#least[slot] as number)) this.#least[slot] = value;
    if (value > (this.#most[slot] as number)) this.#most[slot] = value;
  }

  /** Calls `each` for every second within the window that has samples, the oldest first. */
  forEach(fromMs: number, toMs: number, each: (timeMs: number, least: number, most: number) => void): void {
    if (this.#seconds.length === 0) return;
    const first = Math.max(Math.floor(fromMs / SECOND_MS), this.#newest - SECONDS_KEPT + 1, 0);
    const last = Math.min(Math.floor(toMs / SECOND_MS), this.#newest);
    for (let second = first; second <= last; second++) {
      const slot = second % SECONDS_KEPT;
      if (this.#seconds[slot] !== second) continue;
      each(second * SECOND_MS, this.#least[slot] as number, this.#most[slot] as number);
    }
  }

  clear(): void {
    this.#seconds.fill(Number.NaN);
    this.#newest = Number.NEGATIVE_INFINITY;
  }
}

/** A value at an instant. */
export interface SeriesValue {
  readonly value: number;
  /** When it was measured, ms. */
  readonly timeMs: number;
}

/** The values within a window. */
export interface SeriesRange {
  readonly least: number;
  readonly most: number;
}

/**
 * Intervals whose median counts as a value's own. Chosen: two that were lost change nothing, and another rate
 * is known after eight.
 */
const INTERVALS_CONSIDERED = 15;
/**
 * A value is stale after so many of its intervals without another; at least and at most, ms. Chosen: two that
 * are lost on the way are no reason.
 */
const STALE_INTERVALS = 3;
const LEAST_STALE_MS = 500;
const MOST_STALE_MS = 30_000;
/** Before its rate is known, ms. Chosen: as readings (shown-readings.ts). */
const UNKNOWN_STALE_MS = 10_000;

export class Series {
  readonly #ring: SampleRing;
  readonly #extremes = new ExtremesRing();
  readonly #intervals: number[] = [];
  #intervalMs: number | null = null;
  #newestMs = Number.NEGATIVE_INFINITY;

  /** @param most samples that are kept */
  constructor(most?: number) {
    this.#ring = new SampleRing(most);
  }

  get newestMs(): number {
    return this.#newestMs;
  }

  get length(): number {
    return this.#ring.length;
  }

  add(timeMs: number, value: number): RingVerdict {
    const verdict = this.#ring.add(timeMs, value);
    if (verdict !== 'added') return verdict;
    this.#extremes.add(timeMs, value);
    if (timeMs > this.#newestMs) {
      if (this.#newestMs !== Number.NEGATIVE_INFINITY) this.#observe(timeMs - this.#newestMs);
      this.#newestMs = timeMs;
    }
    return verdict;
  }

  /** The newest value that is not newer than the instant; `null` if there is none. */
  at(instantMs: number): SeriesValue | null {
    const index = this.#ring.indexAt(instantMs);
    return index < 0 ? null : { value: this.#ring.valueAt(index), timeMs: this.#ring.timeAt(index) };
  }

  /** After how long without another sample a value is stale, ms: its own rate decides. */
  get staleMs(): number {
    if (this.#intervalMs === null) return UNKNOWN_STALE_MS;
    return Math.min(Math.max(STALE_INTERVALS * this.#intervalMs, LEAST_STALE_MS), MOST_STALE_MS);
  }

  /** The smallest and the largest value of the window; `null` without any. */
  range(fromMs: number, toMs: number): SeriesRange | null {
    let least = Number.POSITIVE_INFINITY;
    let most = Number.NEGATIVE_INFINITY;
    this.#forEach(fromMs, toMs, (_, low, high) => {
      if (low < least) least = low;
      if (high > most) most = high;
    });
    return least > most ? null : { least, most };
  }

  /**
   * Draws the window into `into`: at most the smallest and the largest value of each of its columns, so that no spike is
   * lost, and gaps where nothing came for longer than {@link staleMs}.
   */
  curve(fromMs: number, toMs: number, into: Curve): void {
    into.begin(fromMs, toMs, this.#isCoarse(fromMs) ? this.staleMs + EXTREMES_MS : this.staleMs);
    this.#forEach(fromMs, toMs, (timeMs, low, high) => {
      into.add(timeMs, low);
      if (high !== low) into.add(timeMs, high);
    });
    into.end();
  }

  clear(): void {
    this.#ring.clear();
    this.#extremes.clear();
    this.#intervals.length = 0;
    this.#intervalMs = null;
    this.#newestMs = Number.NEGATIVE_INFINITY;
  }

  /** The samples; where they do not reach back far enough, the extremes of each second. */
  #forEach(fromMs: number, toMs: number, each: (timeMs: number, low: number, high: number) => void): void {
    const ring = this.#ring;
    if (this.#isCoarse(fromMs)) {
      this.#extremes.forEach(fromMs, toMs, each);
      return;
    }
    const last = ring.indexAt(toMs);
    for (let i = Math.max(0, ring.indexAt(fromMs)); i <= last; i++) {
      const timeMs = ring.timeAt(i);
      if (timeMs >= fromMs) each(timeMs, ring.valueAt(i), ring.valueAt(i));
    }
  }

  /** Whether the window begins before the oldest sample that is kept. */
  #isCoarse(fromMs: number): boolean {
    return this.#ring.isFull && this.#ring.timeAt(0) > fromMs;
  }

  #observe(intervalMs: number): void {
    this.#intervals.push(intervalMs);
    if (this.#intervals.length > INTERVALS_CONSIDERED) this.#intervals.shift();
    const sorted = this.#intervals.toSorted((a, b) => a - b);
    this.#intervalMs = sorted[sorted.length >> 1] ?? null;
  }
}
