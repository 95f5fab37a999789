import { floorClasses, type SensorGrid } from './sensor-grid.ts';

/** Cells along a side: a power of two, so that a cell's place is found with a mask. */
export const LAYER_SIDE = 256;
const MASK = LAYER_SIDE - 1;
const HALF = LAYER_SIDE / 2;
const FORGOTTEN = Number.NEGATIVE_INFINITY;
/** Four cells of which nothing is known, as one number. */
const FOUR_UNKNOWN = floorClasses.unknown * 0x01010101;

/** How long a cell is remembered. */
export interface FloorMemory {
  /** How long a cell counts as free after it was last seen, ms. */
  freeMemoryMs: number;
  /** How long a cell counts as occupied, or without a floor, after it was last seen, ms. */
  occupiedMemoryMs: number;
  /** Without odometry, a cell no longer counts as free when the robot has gone this far since, metres. */
  freeMemoryM: number;
}

/** Cells around a place, by the numbers of their columns and rows. */
export interface CellRectangle {
  left: number;
  low: number;
  width: number;
  height: number;
}

/**
 * What sensors of one kind say about the cells around the robot. A cell is what the newest grid that sees it says; of
 * grids of the same age, an obstacle wins. Where something stands, a sensor that sees the floor of the cell and not as far up
 * as it stood says nothing. What is no longer seen is remembered for a while: an obstacle does not go away
 * because the robot came too near to see it.
 */
export class FloorLayer {
  readonly #memory: FloorMemory;
  readonly #classes = new Uint8Array(LAYER_SIDE * LAYER_SIDE);
  /** When each cell was last seen, ms. */
  readonly #seenMs = new Float64Array(LAYER_SIDE * LAYER_SIDE).fill(FORGOTTEN);
  /** Up to where what stands in a cell must be seen to be gone. */
  readonly #heights = new Uint8Array(LAYER_SIDE * LAYER_SIDE);
  /** How far the robot had gone by then, metres: only counts without odometry. */
  readonly #seenTravel = new Float64Array(LAYER_SIDE * LAYER_SIDE);
  #centreX = 0;
  #centreY = 0;

  constructor(memory: FloorMemory) {
    this.#memory = memory;
  }

  /** Moves the layer so that it lies around this cell. What falls off its edge is forgotten. */
  centreOn(x: number, y: number): void {
    const [dx, dy] = [x - this.#centreX, y - this.#centreY];
    if (dx === 0 && dy === 0) return;
    this.#centreX = x;
    this.#centreY = y;
    if (Math.abs(dx) >= LAYER_SIDE || Math.abs(dy) >= LAYER_SIDE) {
      this.forget();
      return;
    }
    // The columns and rows that entered have those cells' old contents.
    for (let k = 0; k < Math.abs(dx); k++) {
      const column = (dx > 0 ? x + HALF - 1 - k : x - HALF + k) & MASK;
      for (let row = 0; row < LAYER_SIDE; row++) this.#seenMs[row * LAYER_SIDE + column] = FORGOTTEN;
    }
    for (let k = 0; k < Math.abs(dy); k++) {
      const row = (dy > 0 ? y + HALF - 1 - k : y - HALF + k) & MASK;
      this.#seenMs.fill(FORGOTTEN, row * LAYER_SIDE, (row + 1) * LAYER_SIDE);
    }
  }

  forget(): void {
    this.#seenMs.fill(FORGOTTEN);
  }

  /** Takes what a sensor says. @param travel how far the robot had gone when it was taken, metres */
  merge({ side, classes, heights, firstX, firstY, capturedAtMs }: SensorGrid, travel: number): void {
    const [left, right] = [this.#centreX - HALF, this.#centreX + HALF];
    const [low, high] = [this.#centreY - HALF, this.#centreY + HALF];
    const from = Math.max(0, left - firstX);
    const until = Math.min(side, right - firstX);
    const [seenMs, known, seenTravel] = [this.#seenMs, this.#classes, this.#seenTravel];
    const { occupiedMemoryMs } = this.#memory;
    const fours = foursOf(classes, side);
    for (let j = Math.max(0, low - firstY); j < Math.min(side, high - firstY); j++) {
      const row = ((firstY + j) & MASK) * LAYER_SIDE;
      for (let i = from; i < until; i++) {
        if (fours !== null && i % 4 === 0 && fours[(j * side + i) >> 2] === FOUR_UNKNOWN) {
          i += 3;
          continue;
        }
        const said = classes[j * side + i] as number;
        if (said === floorClasses.unknown) continue;
        const cell = row + ((firstX + i) & MASK);
        const before = seenMs[cell] as number;
        if (before > capturedAtMs) continue;
        if (before === capturedAtMs && (known[cell] as number) > said) continue;
        if (heights !== undefined) {
          const stands = known[cell] === floorClasses.occupied && capturedAtMs - before <= occupiedMemoryMs;
          const height = heights[j * side + i] as number;
          // The floor below what stands there says nothing about it.
          if (stands && said === floorClasses.free && height < (this.#heights[cell] as number)) continue;
          if (said === floorClasses.occupied)
            this.#heights[cell] = stands ? Math.min(height, this.#heights[cell] as number) : height;
        }
        known[cell] = said;
        seenMs[cell] = capturedAtMs;
        seenTravel[cell] = travel;
      }
    }
  }

  /**
   * What is known of a cell.
   *
   * @param travel how far the robot has gone by now, metres @param placed whether that does not count: there is odometry
   */
  classAt(x: number, y: number, nowMs: number, travel: number, placed: boolean): number {
    const [dx, dy] = [x - this.#centreX + HALF, y - this.#centreY + HALF];
    if (dx < 0 || dx >= LAYER_SIDE || dy < 0 || dy >= LAYER_SIDE) return floorClasses.unknown;
    const cell = (y & MASK) * LAYER_SIDE + (x & MASK);
    const known = this.#classes[cell] as number;
    const ageMs = nowMs - (this.#seenMs[cell] as number);
    const { freeMemoryMs, occupiedMemoryMs, freeMemoryM } = this.#memory;
    if (known !== floorClasses.free) return ageMs <= occupiedMemoryMs ? known : floorClasses.unknown;
    if (!(ageMs <= freeMemoryMs)) return floorClasses.unknown;
    if (placed || travel - (this.#seenTravel[cell] as number) <= freeMemoryM) return known;
    return floorClasses.unknown;
  }

  /** What is known of a rectangle of cells, row by row from its lowest: as `classAt` says, without a call for each. */
  read(
    cells: Readonly<CellRectangle>,
    nowMs: number,
    travel: number,
    placed: boolean,
    into: Uint8Array,
  ): void {
    const { left, low, width, height } = cells;
    let at = 0;
    for (let y = low; y < low + height; y++)
      for (let x = left; x < left + width; x++) into[at++] = this.classAt(x, y, nowMs, travel, placed);
  }

  /** How far the robot had gone when a cell was last seen, metres. */
  travelAt(x: number, y: number): number {
    return this.#seenTravel[(y & MASK) * LAYER_SIDE + (x & MASK)] as number;
  }
}

/** A grid's cells four at a time, as numbers: of most cells nothing is known. `null` if they do not lie so in memory. */
function foursOf(classes: Uint8Array, side: number): Uint32Array | null {
  if (side % 4 !== 0 || classes.byteOffset % 4 !== 0) return null;
  return new Uint32Array(classes.buffer, classes.byteOffset, classes.length >> 2);
}
