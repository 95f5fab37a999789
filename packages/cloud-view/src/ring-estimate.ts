/**
 * Finds the rings of a LiDAR in the elevations of some of its points: where they crowd, and are rare between. Bounded
 * memory, no clock. Clouds without rings, and rings closer together than the points' coordinates resolve, have no
 * estimate: better none than a wrong one.
 */
import { MAX_RINGS } from '@farpoint/protocol';

/** Bins of 0.05° over all elevations. */
const BINS = 3600;
const BIN_RAD = Math.PI / BINS;
/** As many points as this before there is an estimate, and another one. */
const EVERY_SAMPLES = 2000;
/** Beyond this, older samples count less. */
const MOST_SAMPLES = 100_000;
/** Fewer rings are none: floor and ceiling of a room crowd, too. */
const LEAST_RINGS = 4;
/** A ring with fewer points is not told from chance. */
const LEAST_SAMPLES = 8;
/** Between rings there are fewer points than this share of the lower ring's. */
const VALLEY = 0.5;
/**
 * Mean distance of points from their ring, in distances between rings. Points without rings have 0.25.
 * Chosen: nearer to even rings than to chance; ring-estimate.test.ts has clouds of both.
 */
const MOST_SPREAD = 0.14;

export class RingEstimator {
  readonly #bins = new Float32Array(BINS);
  readonly #smooth = new Float32Array(BINS);
  #samples = 0;
  #untilNext = EVERY_SAMPLES;
  #elevations: readonly number[] | null = null;

  /** Elevations of the rings, radians, ascending; `null` if there are none, or too few points have come. */
  get elevations(): readonly number[] | null {
    return this.#elevations;
  }

  /** @param elevation of a point, seen from the sensor, radians */
  add(elevation: number): void {
    const bin = Math.floor((elevation + Math.PI / 2) / BIN_RAD);
    if (!(bin >= 0 && bin < BINS)) return;
    this.#bins[bin]!++;
    this.#samples++;
    if (--this.#untilNext > 0) return;
    this.#untilNext = EVERY_SAMPLES;
    this.#elevations = this.#find();
    if (this.#samples < MOST_SAMPLES) return;
    for (let i = 0; i < BINS; i++) this.#bins[i]! /= 2;
    this.#samples /= 2;
  }

  /** Forgets all points. */
  reset(): void {
    this.#bins.fill(0);
    this.#samples = 0;
    this.#untilNext = EVERY_SAMPLES;
    this.#elevations = null;
  }

  #find(): number[] | null {
    const found: number[] = [];
    this.#eachCrowd((first, last) => {
      let [count, sum] = [0, 0];
      for (let i = first; i <= last; i++) {
        count += this.#bins[i]!;
        sum += this.#bins[i]! * (i + 0.5);
      }
      if (count >= LEAST_SAMPLES) found.push((sum / count) * BIN_RAD - Math.PI / 2);
    });
    if (found.length < LEAST_RINGS || found.length > MAX_RINGS) return null;
    return this.#spread(found) <= MOST_SPREAD ? found : null;
  }

  /** Calls back with the bins from each valley to the next. */
  #eachCrowd(take: (first: number, last: number) => void): void {
    const [bins, smooth] = [this.#bins, this.#smooth];
    for (let i = 0; i < BINS; i++) smooth[i] = ((bins[i - 1] ?? 0) + 2 * bins[i]! + (bins[i + 1] ?? 0)) / 4;
    let first = 0;
    let peak = 0;
    let [valley, valleyAt] = [0, 0];
    let falling = false;
    for (let i = 0; i < BINS; i++) {
      const value = smooth[i]!;
      if (!falling) {
        if (value > peak) peak = value;
        else if (value < peak * VALLEY) {
          falling = true;
          [valley, valleyAt] = [value, i];
        }
      } else if (value < valley) {
        [valley, valleyAt] = [value, i];
      } else if (value * VALLEY > valley && value >= 1) {
        take(first, valleyAt);
        [first, peak, falling] = [valleyAt + 1, value, false];
      }
    }
    if (peak > 0) take(first, BINS - 1);
  }

  /** Mean distance of all points from the nearest ring, in distances between rings there. */
  #spread(rings: readonly number[]): number {
    let [sum, count] = [0, 0];
    for (let i = 0, ring = 0; i < BINS; i++) {
      const points = this.#bins[i]!;
      if (points === 0) continue;
      const at = (i + 0.5) * BIN_RAD - Math.PI / 2;
      while (ring < rings.length - 1 && rings[ring + 1]! - at < at - rings[ring]!) ring++;
      const here = rings[ring]!;
      const other =
        at < here ? (rings[ring - 1] ?? here - (rings[1]! - rings[0]!)) : (rings[ring + 1] ?? null);
      const gap = other === null ? here - rings[ring - 1]! : Math.abs(here - other);
      sum += points * Math.min(Math.abs(at - here) / gap, 0.5);
      count += points;
    }
    return sum / count;
  }
}
