/**
 * Finds the elevations of a LiDAR's rings from clouds that say which ring measured a point: by a field `ring` (as of
 * Velodyne's and Ouster's drivers), or by rows. A few clouds are enough, and then no more are looked at.
 */
import { MAX_RINGS } from '@farpoint/protocol';
import type { PointCloud2 } from './messages.ts';
import { fieldReader, readableField } from './point-field.ts';

/** Clouds that are looked at, and points of each. */
const MOST_CLOUDS = 20;
const MOST_POINTS = 8192;
const LEAST_RINGS = 2;
/** A ring's elevation is the mean of at least so many points. */
const LEAST_POINTS = 8;
/** The lasers are some centimetres beside the sensor's origin: nearer points have another elevation, metres. */
const LEAST_RANGE_M = 1.5;
/** Rings are no closer, radians. */
const LEAST_GAP = 0.0005;
/**
 * Deviation of points from their ring, in mean distances between rings. It is larger for rows that are no rings, as of a
 * depth camera, and for clouds in another frame than the sensor's.
 */
const MOST_DEVIATION = 0.4;

/** Of Velodyne's, Ouster's, Hesai's and RoboSense's drivers. */
const RING_FIELDS = ['ring', 'channel'];

export class RingFinder {
  readonly #count = new Uint32Array(MAX_RINGS);
  readonly #sum = new Float64Array(MAX_RINGS);
  readonly #squares = new Float64Array(MAX_RINGS);
  #clouds = 0;
  #elevations: readonly number[] | null = null;

  /** Radians above the horizontal plane of the cloud's frame, ascending; `null` until they are known. */
  get elevations(): readonly number[] | null {
    return this.#elevations;
  }

  /** @param points x, y, z in the optical frame and a fourth word, for each point of the cloud */
  take(cloud: PointCloud2, points: Float32Array): void {
    if (this.#clouds >= MOST_CLOUDS) return;
    this.#clouds++;
    const ringOf = ringReader(cloud);
    if (ringOf === null) return;
    const all = cloud.width * cloud.height;
    const step = Math.max(1, Math.ceil(all / MOST_POINTS));
    // A step of its own phase in each cloud, so that no ring is always left out.
    for (let i = this.#clouds % step; i < all; i += step) {
      const [x, y, z] = [points[i * 4]!, points[i * 4 + 1]!, points[i * 4 + 2]!];
      const ring = ringOf(i);
      // NaN fails the comparison.
      if (!(Math.hypot(x, y, z) >= LEAST_RANGE_M) || !(ring >= 0 && ring < MAX_RINGS)) continue;
      const elevation = Math.atan2(-y, Math.hypot(x, z));
      this.#count[ring]!++;
      this.#sum[ring]! += elevation;
      this.#squares[ring]! += elevation * elevation;
    }
    const found = this.#find();
    // Rings that hit nothing at first are added later.
    if (found !== null && found.length !== this.#elevations?.length) this.#elevations = found;
  }

  #find(): number[] | null {
    const means: number[] = [];
    let [deviations, points] = [0, 0];
    for (let ring = 0; ring < MAX_RINGS; ring++) {
      const count = this.#count[ring]!;
      if (count < LEAST_POINTS) continue;
      const mean = this.#sum[ring]! / count;
      means.push(mean);
      deviations += Math.max(this.#squares[ring]! - count * mean * mean, 0);
      points += count;
    }
    if (means.length < LEAST_RINGS) return null;
    means.sort((a, b) => a - b);
    const gap = (means.at(-1)! - means[0]!) / (means.length - 1);
    if (means.some((mean, i) => i > 0 && mean - means[i - 1]! < LEAST_GAP)) return null;
    return Math.sqrt(deviations / points) <= gap * MOST_DEVIATION ? means : null;
  }
}

/** Which ring measured a point, by the point's index; `null` if the cloud does not say so. */
function ringReader(cloud: PointCloud2): ((point: number) => number) | null {
  const { width, height } = cloud;
  const field = readableField(cloud, ...RING_FIELDS);
  if (field !== undefined) return fieldReader(cloud, field);
  return height >= LEAST_RINGS && height <= MAX_RINGS ? (point) => Math.floor(point / width) : null;
}
