/**
 * How high the ground lies that a cloud shows, and how far the cloud reaches: from a few samples of its points. No clock
 * here; allocates nothing.
 *
 * The ground is the height at which most square metres have their lowest sample. A few that are lower (reflections, a
 * stair) or higher (what hides the ground) change nothing.
 */
import type { Vector3 as Position, Quaternion } from '@farpoint/operator';

/** Samples that are kept: ten frames of 200 (point-colouring.ts), and a power of two. */
const SAMPLES = 2048;
/** With fewer samples nothing is said. Chosen: two frames. */
const LEAST_SAMPLES = 256;
/** The samples are evaluated this often, ms. */
const INTERVAL_MS = 500;
/** Share of the samples that are nearer than the extent: some points are far outside, or wrong. */
const EXTENT_SHARE = 0.95;
/** Cells of a square metre around the sensor in which ground is looked for. */
const SIDE = 48;
/** A cell with fewer samples may have none of its ground. */
const LEAST_IN_CELL = 3;
/** Ground is as flat as this, metres. */
const FLAT_M = 0.3;
/** It is ground if at least so many cells are of it, and this share of all. */
const LEAST_CELLS = 12;
const LEAST_SHARE = 0.3;
/**
 * The robot's own ground counts as seen if this share of the cells around the robot, up to so many to each side, is within
 * half of {@link FLAT_M} of it. Farther away, walls may be seen at its height.
 */
const OWN_SHARE = 0.15;
const AROUND = 6;
/** Evaluations that differ by less agree, metres. One that no other agrees with is ignored. */
const AGREED_M = 0.15;
/** Weight of the latest evaluation. */
const SMOOTHING = 0.3;

/** What is seen of a scene as a whole. */
export interface SceneFigures {
  /**
   * Height in the robot's world of the ground that is seen, metres. `null`: none is seen, or it is the robot's own, to
   * which its poses belong.
   */
  readonly ground: number | null;
  /** How far from the sensor most of the points are, horizontally, metres; `null` until it is known. */
  readonly extent: number | null;
}

export class SceneEstimate implements SceneFigures {
  ground: number | null = null;
  extent: number | null = null;
  readonly #x = new Float32Array(SAMPLES);
  readonly #y = new Float32Array(SAMPLES);
  readonly #z = new Float32Array(SAMPLES);
  readonly #sorted = new Float32Array(SAMPLES);
  readonly #lowest = new Float32Array(SIDE * SIDE);
  readonly #inCell = new Uint16Array(SIDE * SIDE);
  readonly #lows = new Float32Array(SIDE * SIDE);
  #count = 0;
  #next = 0;
  #evaluatedMs: number | null = null;
  #previous: number | null = null;

  /**
   * Takes a sample. The oldest of {@link SAMPLES} is forgotten.
   *
   * @param position of the sensor in the world, metres @param orientation of the sensor
   * @param x in the sensor's frame, metres, as are `y` and `z`
   */
  add(position: Position, { x: qx, y: qy, z: qz, w }: Quaternion, x: number, y: number, z: number): void {
    const [tx, ty, tz] = [2 * (qy * z - qz * y), 2 * (qz * x - qx * z), 2 * (qx * y - qy * x)];
    const at = this.#next;
    this.#x[at] = position.x + x + w * tx + qy * tz - qz * ty;
    this.#y[at] = position.y + y + w * ty + qz * tx - qx * tz;
    this.#z[at] = position.z + z + w * tz + qx * ty - qy * tx;
    this.#next = (at + 1) % SAMPLES;
    this.#count = Math.min(this.#count + 1, SAMPLES);
  }

  /**
   * Call it with every display frame.
   *
   * @param nowMs `performance.now()` @param sensor where it is by now, metres
   * @param base height of the robot's own ground in the world, metres
   */
  update(nowMs: number, sensor: Readonly<{ x: number; y: number }>, base: number): void {
    const last = this.#evaluatedMs;
    if (this.#count < LEAST_SAMPLES || (last !== null && nowMs - last < INTERVAL_MS)) return;
    this.#evaluatedMs = nowMs;
    this.extent = this.#extentFrom(sensor);
    const seen = this.#groundAround(sensor, base);
    const previous = this.#previous;
    this.#previous = seen;
    if (seen === null) {
      // Whatever hides the ground for an instant does not move it.
      if (previous === null) this.ground = null;
    } else if (previous !== null && Math.abs(seen - previous) < AGREED_M) {
      const near = this.ground !== null && Math.abs(seen - this.ground) < FLAT_M;
      this.ground = near ? this.ground! + SMOOTHING * (seen - this.ground!) : seen;
    }
  }

  /** The samples are of another session or another sensor. */
  reset(): void {
    this.ground = null;
    this.extent = null;
    this.#count = 0;
    this.#next = 0;
    this.#evaluatedMs = null;
    this.#previous = null;
  }

  #extentFrom(sensor: Readonly<{ x: number; y: number }>): number {
    const count = this.#count;
    // Empty places sort to the end.
    this.#sorted.fill(Number.POSITIVE_INFINITY);
    for (let i = 0; i < count; i++) {
      const [dx, dy] = [(this.#x[i] as number) - sensor.x, (this.#y[i] as number) - sensor.y];
      this.#sorted[i] = Math.sqrt(dx * dx + dy * dy);
    }
    this.#sorted.sort();
    return this.#sorted[Math.floor(EXTENT_SHARE * (count - 1))] as number;
  }

  #groundAround(sensor: Readonly<{ x: number; y: number }>, base: number): number | null {
    const cells = this.#collectLows(sensor);
    if (this.#seesOwn(base)) return null;
    if (cells < LEAST_CELLS) return null;
    const lows = this.#lows;
    lows.fill(Number.POSITIVE_INFINITY, cells);
    lows.sort();
    // The window of heights with the most cells.
    let [most, from] = [0, 0];
    for (let low = 0, high = 0; high < cells; high++) {
      const height = lows[high] as number;
      while (height - (lows[low] as number) > FLAT_M) low++;
      if (high - low + 1 > most) [most, from] = [high - low + 1, low];
    }
    if (most < LEAST_CELLS || most < LEAST_SHARE * cells) return null;
    return lows[from + (most >> 1)] as number;
  }

  /** Whether the ground around the robot is the one that it knows of. */
  #seesOwn(base: number): boolean {
    let [own, all] = [0, 0];
    for (let row = SIDE / 2 - AROUND; row < SIDE / 2 + AROUND; row++) {
      for (let column = SIDE / 2 - AROUND; column < SIDE / 2 + AROUND; column++) {
        const cell = row * SIDE + column;
        if ((this.#inCell[cell] as number) < LEAST_IN_CELL) continue;
        all++;
        if (Math.abs((this.#lowest[cell] as number) - base) <= FLAT_M / 2) own++;
      }
    }
    return own > 0 && own >= OWN_SHARE * all;
  }

  /** The lowest sample of each cell that has enough. @returns how many cells there are */
  #collectLows(sensor: Readonly<{ x: number; y: number }>): number {
    const [lowest, inCell] = [this.#lowest, this.#inCell];
    lowest.fill(Number.POSITIVE_INFINITY);
    inCell.fill(0);
    for (let i = 0; i < this.#count; i++) {
      const column = Math.floor((this.#x[i] as number) - sensor.x) + SIDE / 2;
      const row = Math.floor((this.#y[i] as number) - sensor.y) + SIDE / 2;
      if (column < 0 || column >= SIDE || row < 0 || row >= SIDE) continue;
      const cell = row * SIDE + column;
      inCell[cell] = (inCell[cell] as number) + 1;
      lowest[cell] = Math.min(lowest[cell] as number, this.#z[i] as number);
    }
    let cells = 0;
    for (let cell = 0; cell < SIDE * SIDE; cell++) {
      if ((inCell[cell] as number) >= LEAST_IN_CELL) this.#lows[cells++] = lowest[cell] as number;
    }
    return cells;
  }
}
