/** Finds floor that a depth camera should see and does not: a hole whose dark or plain inside gives no depth. */
import { type Pose, rotationMatrix } from '@farpoint/protocol';
import { type FloorPose, floorClasses } from '@farpoint/safety';
import type { GridShape } from './shared-grid.ts';

export interface BlankFloorCamera {
  width: number;
  height: number;
  fx: number;
  fy: number;
  cx: number;
  cy: number;
}

/** Farther from the camera, too few pixels see a cell, metres. */
const FARTHEST_M = 2.5;
/** About so many pixels a row are enough. */
const COLUMNS = 240;
/**
 * Of the nine cells of a patch, so many must have a pixel without depth; none may have anything else.
 * `pnpm bench guard-runs` counts falls and false stops with these numbers, in its dock with holes.
 */
const BLANK_CELLS = 6;
/** How far before a patch its floor must be seen: through cells without depth only. */
const MOST_STEPS = 20;
/** A column with fewer pixels that have depth belongs to the image's own border, of which cameras give nothing. */
const LEAST_VALID = 0.05;
/** Of each column, every so many pixels are looked at for that. */
const COLUMN_STEP = 4;
const { unknown, free, dropOff } = floorClasses;

/**
 * A patch of 3 × 3 cells that a camera looks at without seeing anything, behind floor that it does see, is a missing
 * floor. Smaller ones are left alone: cameras lose single pixels anywhere. So are those behind an obstacle, which hides
 * them, and those before which no floor is seen: then the camera may see no floor at all.
 */
export class BlankFloor {
  readonly #shape: GridShape;
  readonly #camera: BlankFloorCamera;
  /** Of each pixel that looks at floor: its place in the image, its column, and the floor's place in base_link. */
  readonly #pixels: Int32Array;
  readonly #columnOf: Int32Array;
  readonly #floor: Float64Array;
  /** Of those, the ones without depth in the present image. */
  readonly #missing: Int32Array;
  readonly #sensor: { x: number; y: number };
  readonly #blank: Uint8Array;
  /** The cells of those. */
  readonly #blankCells: Int32Array;
  readonly #found: number[] = [];

  /** @param mount the pose of the camera's optical frame in base_link */
  constructor(camera: BlankFloorCamera, mount: Pose, shape: GridShape) {
    this.#shape = shape;
    this.#camera = camera;
    this.#blank = new Uint8Array(shape.side ** 2);
    this.#blankCells = new Int32Array(shape.side ** 2);
    this.#sensor = mount.position;
    const { width, height, fx, fy, cx, cy } = camera;
    const [r0, r1, r2, r3, r4, r5, r6, r7, r8] = rotationMatrix(mount.orientation);
    const step = Math.max(1, Math.floor(width / COLUMNS));
    const pixels: number[] = [];
    const floor: number[] = [];
    for (let v = 0; v < height; v += step) {
      for (let u = 0; u < width; u += step) {
        const [a, b] = [(u - cx) / fx, (v - cy) / fy];
        const down = -(r6 * a + r7 * b + r8);
        if (!(down > 0)) continue;
        const along = mount.position.z / down;
        const [x, y] = [along * (r0 * a + r1 * b + r2), along * (r3 * a + r4 * b + r5)];
        if (Math.hypot(x, y) > FARTHEST_M) continue;
        pixels.push(v * width + u);
        floor.push(mount.position.x + x, mount.position.y + y);
      }
    }
    this.#pixels = Int32Array.from(pixels);
    this.#columnOf = this.#pixels.map((pixel) => pixel % width);
    this.#missing = new Int32Array(pixels.length + 1);
    this.#floor = Float64Array.from(floor);
  }

  /**
   * Marks missing floor in the grid of a cloud.
   *
   * @param depth the cloud's depth image, metres; without depth 0, negative or not finite
   * @param base base_link's pose, in the grid's frame, which begins at its middle
   */
  mark(depth: Float32Array, base: Readonly<FloorPose>, classes: Uint8Array): void {
    const { side, cellM } = this.#shape;
    const half = side / 2;
    const [cos, sin] = [Math.cos(base.yaw) / cellM, Math.sin(base.yaw) / cellM];
    const [left, low] = [base.x / cellM + half, base.y / cellM + half];
    const count = this.#collectBlank(depth);
    if (count === 0) return;
    const [missing, floor, blank, cells] = [this.#missing, this.#floor, this.#blank, this.#blankCells];
    blank.fill(0);
    let blanks = 0;
    for (let n = 0; n < count; n++) {
      const k = missing[n] as number;
      const [x, y] = [floor[2 * k] as number, floor[2 * k + 1] as number];
      const i = Math.floor(left + x * cos - y * sin);
      const j = Math.floor(low + x * sin + y * cos);
      const cell = j * side + i;
      if (i < 0 || i >= side || j < 0 || j >= side || classes[cell] !== unknown || blank[cell] === 1)
        continue;
      blank[cell] = 1;
      cells[blanks++] = cell;
    }
    const { x, y } = this.#sensor;
    this.#find(blanks, left + x * cos - y * sin, low + x * sin + y * cos, classes);
    // Not before all are found: what was marked is not looked at again.
    for (const cell of this.#found) this.#fill(cell, classes);
  }

  /**
   * Collects the pixels of floor without depth, of which there are few. A loop of its own, without anything rare in it: the
   * engine compiles it once, and not anew for every cloud.
   *
   * @returns their number
   */
  #collectBlank(depth: Float32Array): number {
    const [pixels, columnOf, missing] = [this.#pixels, this.#columnOf, this.#missing];
    const [first, last] = this.#columns(depth);
    let count = 0;
    for (let k = 0; k < pixels.length; k++) {
      const column = columnOf[k] as number;
      missing[count] = k;
      count += (depth[pixels[k] as number] as number) > 0 || column < first || column > last ? 0 : 1;
    }
    return count;
  }

  /** The first and the last column in which the camera sees anything. */
  #columns(depth: Float32Array): readonly [number, number] {
    const { width } = this.#camera;
    let [first, last] = [0, width - 1];
    while (first < last && !this.#sees(first, depth)) first++;
    while (last > first && !this.#sees(last, depth)) last--;
    return [first, last];
  }

  #sees(column: number, depth: Float32Array): boolean {
    const { width, height } = this.#camera;
    let valid = 0;
    for (let v = 0; v < height; v += COLUMN_STEP) if ((depth[v * width + column] as number) > 0) valid++;
    return valid * COLUMN_STEP > LEAST_VALID * height;
  }

  /** Collects the middles of patches. @param blanks cells without depth @param eyeX,eyeY the camera's foot, cells */
  #find(blanks: number, eyeX: number, eyeY: number, classes: Uint8Array): void {
    const { side } = this.#shape;
    const found = this.#found;
    found.length = 0;
    for (let k = 0; k < blanks; k++) {
      const cell = this.#blankCells[k] as number;
      const i = cell % side;
      const j = (cell - i) / side;
      if (i < 1 || j < 1 || i >= side - 1 || j >= side - 1 || !this.#isPatch(cell, classes)) continue;
      if (this.#followsFloor(i, j, eyeX, eyeY, classes)) found.push(cell);
    }
  }

  #isPatch(middle: number, classes: Uint8Array): boolean {
    const { side } = this.#shape;
    let count = 0;
    for (let row = middle - side; row <= middle + side; row += side) {
      for (let cell = row - 1; cell <= row + 1; cell++) {
        const known = classes[cell];
        if (known === dropOff) count++;
        else if (known !== unknown) return false;
        else count += this.#blank[cell] as number;
      }
    }
    return count >= BLANK_CELLS;
  }

  /** Whether the first thing that is seen on the way to the camera is floor. */
  #followsFloor(i: number, j: number, eyeX: number, eyeY: number, classes: Uint8Array): boolean {
    const { side } = this.#shape;
    const [dx, dy] = [eyeX - i - 0.5, eyeY - j - 0.5];
    const length = Math.hypot(dx, dy);
    for (let step = 1; step <= MOST_STEPS && step < length; step++) {
      const x = Math.floor(i + 0.5 + (dx / length) * step);
      const y = Math.floor(j + 0.5 + (dy / length) * step);
      if (x < 0 || x >= side || y < 0 || y >= side) return false;
      const known = classes[y * side + x];
      if (known !== unknown) return known === free || known === dropOff;
    }
    return false;
  }

  #fill(middle: number, classes: Uint8Array): void {
    const { side } = this.#shape;
    for (let row = middle - side; row <= middle + side; row += side) {
      for (let cell = row - 1; cell <= row + 1; cell++)
        if (classes[cell] === unknown) classes[cell] = dropOff;
    }
  }
}
