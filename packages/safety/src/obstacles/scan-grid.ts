import { type Pose, rotationMatrix } from '@farpoint/protocol';
import { FLOOR_SLOPE, type FloorPose, floorClasses } from './sensor-grid.ts';

/** What a planar laser scanner measured in one sweep. Angles in radians, anticlockwise from its x axis; metres. */
export interface Scan {
  angleMin: number;
  angleIncrement: number;
  rangeMin: number;
  rangeMax: number;
  /**
   * As REP 117 says: +∞ means that nothing is within `rangeMax`, −∞ that something is too near to be measured, NaN that
   * nobody can tell. Finite numbers out of range are no measurements.
   */
  ranges: ArrayLike<number>;
}

export interface ScanGridOptions {
  /** Cells along a side, an even number; and their length, metres. */
  side: number;
  cellM: number;
  /** The pose of the scanner's frame (x ahead, y left, scanning in its x-y plane) in base_link. */
  mount: Pose;
  /** What is lower is floor; what is higher is passed under, metres. */
  clearanceM: number;
  heightM: number;
}

/**
 * A grid of the floor from one scan: cells in which something stands, and cells that the rays passed through at a height
 * at which the robot would have hit something. It knows nothing of what is above or below its plane, a missing floor
 * included.
 */
export class ScanGrid {
  readonly classes: Uint8Array;
  readonly #options: ScanGridOptions;
  readonly #rotation: ReturnType<typeof rotationMatrix>;

  constructor(options: ScanGridOptions) {
    this.#options = options;
    this.classes = new Uint8Array(options.side ** 2);
    this.#rotation = rotationMatrix(options.mount.orientation);
  }

  /**
   * Judges a scan. Base_link moved evenly between the first ray and the last.
   *
   * @param from,to base_link's pose at the first and the last ray, in the grid's frame, which begins at the middle of
   *   the grid
   * @returns how many rays measured something, be it that nothing is there
   */
  look(scan: Scan, from: Readonly<FloorPose>, to: Readonly<FloorPose> = from): number {
    this.classes.fill(floorClasses.unknown);
    // Obstacles first: a ray beside one takes nothing away.
    this.#each(scan, from, to, (x, y, dx, dy, dz, range) => this.#hit(scan, x, y, dx, dy, dz, range));
    return this.#each(scan, from, to, (x, y, dx, dy, dz, range) => this.#pass(scan, x, y, dx, dy, dz, range));
  }

  /** Visits each valid ray: where it begins, its direction, and its range. @returns how many there are */
  #each(
    { angleMin, angleIncrement, rangeMin, rangeMax, ranges }: Scan,
    from: Readonly<FloorPose>,
    to: Readonly<FloorPose>,
    visit: (x: number, y: number, dx: number, dy: number, dz: number, range: number) => void,
  ): number {
    const { x: mountX, y: mountY } = this.#options.mount.position;
    const [r00, r01, , r10, r11, , r20, r21] = this.#rotation;
    const count = ranges.length;
    let valid = 0;
    for (let i = 0; i < count; i++) {
      const range = ranges[i] as number;
      if (Number.isNaN(range)) continue;
      if (Number.isFinite(range) && (range < rangeMin || range > rangeMax)) continue;
      valid++;
      const angle = angleMin + i * angleIncrement;
      const [ca, sa] = [Math.cos(angle), Math.sin(angle)];
      const bx = r00 * ca + r01 * sa;
      const by = r10 * ca + r11 * sa;
      const bz = r20 * ca + r21 * sa;
      const share = count > 1 ? i / (count - 1) : 0;
      const yaw = from.yaw + (to.yaw - from.yaw) * share;
      const [cos, sin] = [Math.cos(yaw), Math.sin(yaw)];
      visit(
        from.x + (to.x - from.x) * share + mountX * cos - mountY * sin,
        from.y + (to.y - from.y) * share + mountX * sin + mountY * cos,
        bx * cos - by * sin,
        bx * sin + by * cos,
        bz,
        range,
      );
    }
    return valid;
  }

  #hit({ rangeMin }: Scan, x: number, y: number, dx: number, dy: number, dz: number, range: number): void {
    if (range === Number.POSITIVE_INFINITY) return;
    const at = range === Number.NEGATIVE_INFINITY ? rangeMin : range;
    const { clearanceM, heightM, mount } = this.#options;
    const z = mount.position.z + dz * at;
    if (z <= clearanceM + FLOOR_SLOPE * at || z > heightM) return;
    const cell = this.#cellOf(x + dx * at, y + dy * at);
    if (cell !== null) this.classes[cell] = floorClasses.occupied;
  }

  /** Marks the cells that a ray passes through before it meets something. */
  #pass(scan: Scan, x: number, y: number, dx: number, dy: number, dz: number, range: number): void {
    if (range === Number.NEGATIVE_INFINITY) return;
    const { cellM } = this.#options;
    const reach = this.#reachInBand(dz);
    // Farther, a thing as large as a cell may stand between two rays.
    const dense = cellM / Math.abs(scan.angleIncrement);
    const end = Math.min(range, scan.rangeMax, reach, dense);
    const across = Math.hypot(dx, dy);
    if (!(end > 0) || across < 1e-6) return;
    this.#walk(x, y, dx, dy, end);
  }

  /** How far a ray stays at a height at which the robot would hit something, metres. */
  #reachInBand(dz: number): number {
    const { clearanceM, heightM, mount } = this.#options;
    const { z } = mount.position;
    if (z <= clearanceM || z > heightM) return 0;
    if (dz > 0) return (heightM - z) / dz;
    return dz < 0 ? (clearanceM - z) / dz : Number.POSITIVE_INFINITY;
  }

  /** Visits every cell along a ray, in order. */
  #walk(x: number, y: number, dx: number, dy: number, end: number): void {
    const { side, cellM } = this.#options;
    const half = side / 2;
    const [u, v] = [x / cellM + half, y / cellM + half];
    let [i, j] = [Math.floor(u), Math.floor(v)];
    const [stepX, stepY] = [Math.sign(dx), Math.sign(dy)];
    // Range at which the ray leaves the cell along each axis, and from one border to the next.
    const perX = dx === 0 ? Number.POSITIVE_INFINITY : cellM / Math.abs(dx);
    const perY = dy === 0 ? Number.POSITIVE_INFINITY : cellM / Math.abs(dy);
    let nextX = dx === 0 ? Number.POSITIVE_INFINITY : perX * (dx > 0 ? i + 1 - u : u - i);
    let nextY = dy === 0 ? Number.POSITIVE_INFINITY : perY * (dy > 0 ? j + 1 - v : v - j);
    while (i >= 0 && i < side && j >= 0 && j < side) {
      const out = Math.min(nextX, nextY);
      // The cell in which it ends is not passed through.
      if (out > end) return;
      const cell = j * side + i;
      if (this.classes[cell] === floorClasses.unknown) this.classes[cell] = floorClasses.free;
      if (nextX <= nextY) {
        i += stepX;
        nextX += perX;
      } else {
        j += stepY;
        nextY += perY;
      }
    }
  }

  #cellOf(x: number, y: number): number | null {
    const { side, cellM } = this.#options;
    const [i, j] = [Math.floor(x / cellM + side / 2), Math.floor(y / cellM + side / 2)];
    return i >= 0 && i < side && j >= 0 && j < side ? j * side + i : null;
  }
}
