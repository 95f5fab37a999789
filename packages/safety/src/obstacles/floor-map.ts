import { floorClasses, type SensorGrid } from './sensor-grid.ts';

/** Cells along a side of the map: a power of two, so that a cell's place is found with a mask. */
const SIDE = 256;
const MASK = SIDE - 1;
const HALF = SIDE / 2;

export interface FloorMapOptions {
  cellM: number;
  /** How long a cell counts as free after it was last seen, ms. */
  freeMemoryMs: number;
  /** How long a cell counts as occupied, or without a floor, after it was last seen, ms. */
  occupiedMemoryMs: number;
  /** Without odometry, a cell no longer counts as free when the robot has gone this far since, metres. */
  freeMemoryM: number;
}

/**
 * What all sensors together say about the floor around the robot. A cell is what the newest cloud that sees it says; of
 * clouds of the same age, an obstacle wins. What is no longer seen is remembered for a while: an obstacle does not go away
 * because the robot came too near to see it.
 */
export class FloorMap {
  readonly cellM: number;
  readonly #options: FloorMapOptions;
  readonly #classes = new Uint8Array(SIDE * SIDE);
  /** When each cell was last seen, ms. */
  readonly #seenMs = new Float64Array(SIDE * SIDE).fill(Number.NEGATIVE_INFINITY);
  /** How far the robot had gone by then, metres: only counts without odometry. */
  readonly #seenTravel = new Float64Array(SIDE * SIDE);
  #centreX = 0;
  #centreY = 0;
  #placed = true;

  constructor(options: FloorMapOptions) {
    this.#options = options;
    this.cellM = options.cellM;
  }

  /** Whether its cells stay where they are when the robot moves. */
  get placed(): boolean {
    return this.#placed;
  }

  /** The cell of a coordinate, metres. */
  cellOf(metres: number): number {
    return Math.floor(metres / this.cellM);
  }

  /** Moves the map so that it lies around this cell. What falls off its edge is forgotten. */
  centreOn(x: number, y: number): void {
    const [dx, dy] = [x - this.#centreX, y - this.#centreY];
    if (dx === 0 && dy === 0) return;
    [this.#centreX, this.#centreY] = [x, y];
    if (Math.abs(dx) >= SIDE || Math.abs(dy) >= SIDE) {
      this.forget();
      return;
    }
    // The columns and rows that entered have those cells' old contents.
    for (let k = 0; k < Math.abs(dx); k++) {
      const column = (dx > 0 ? x + HALF - 1 - k : x - HALF + k) & MASK;
      for (let row = 0; row < SIDE; row++) this.#seenMs[row * SIDE + column] = Number.NEGATIVE_INFINITY;
    }
    for (let k = 0; k < Math.abs(dy); k++) {
      const row = (dy > 0 ? y + HALF - 1 - k : y - HALF + k) & MASK;
      this.#seenMs.fill(Number.NEGATIVE_INFINITY, row * SIDE, (row + 1) * SIDE);
    }
  }

  forget(): void {
    this.#seenMs.fill(Number.NEGATIVE_INFINITY);
  }

  /**
   * Takes what a cloud says.
   *
   * @param travel how far the robot had gone when it was taken, metres
   */
  merge({ side, classes, firstX, firstY, capturedAtMs, placed }: SensorGrid, travel: number): void {
    if (placed !== this.#placed) this.forget();
    this.#placed = placed;
    const [left, right] = [this.#centreX - HALF, this.#centreX + HALF];
    const [low, high] = [this.#centreY - HALF, this.#centreY + HALF];
    const from = Math.max(0, left - firstX);
    const until = Math.min(side, right - firstX);
    const [seenMs, known, seenTravel] = [this.#seenMs, this.#classes, this.#seenTravel];
    for (let j = Math.max(0, low - firstY); j < Math.min(side, high - firstY); j++) {
      const row = ((firstY + j) & MASK) * SIDE;
      for (let i = from; i < until; i++) {
        const said = classes[j * side + i] as number;
        if (said === floorClasses.unknown) continue;
        const cell = row + ((firstX + i) & MASK);
        const before = seenMs[cell] as number;
        if (before > capturedAtMs) continue;
        if (before === capturedAtMs && (known[cell] as number) > said) continue;
        known[cell] = said;
        seenMs[cell] = capturedAtMs;
        seenTravel[cell] = travel;
      }
    }
  }

  /** What is known of a cell. @param travel how far the robot has gone by now, metres */
  classAt(x: number, y: number, nowMs: number, travel: number): number {
    const [dx, dy] = [x - this.#centreX + HALF, y - this.#centreY + HALF];
    if (dx < 0 || dx >= SIDE || dy < 0 || dy >= SIDE) return floorClasses.unknown;
    const cell = (y & MASK) * SIDE + (x & MASK);
    const known = this.#classes[cell] as number;
    const ageMs = nowMs - (this.#seenMs[cell] as number);
    const { freeMemoryMs, occupiedMemoryMs, freeMemoryM } = this.#options;
    if (known !== floorClasses.free) return ageMs <= occupiedMemoryMs ? known : floorClasses.unknown;
    if (!(ageMs <= freeMemoryMs)) return floorClasses.unknown;
    if (this.#placed || travel - (this.#seenTravel[cell] as number) <= freeMemoryM) return known;
    return floorClasses.unknown;
  }

  /** How far the robot may have come nearer to a cell since it was seen, metres. */
  travelSince(x: number, y: number, travel: number): number {
    if (this.#placed) return 0;
    return Math.max(0, travel - (this.#seenTravel[(y & MASK) * SIDE + (x & MASK)] as number));
  }
}
