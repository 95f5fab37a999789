/**
 * How far one sees in each direction from where a frame was captured: the least range in each cell of an octahedral map
 * of all directions, whose cells are some 0.6° wide. Serves cameras and LiDARs alike. Allocates nothing.
 */

/** Cells along the map's side. */
const SIDE = 192;
/**
 * With fewer of the nine cells around a direction seen, nothing is said about it. One ring of a LiDAR fills fewer: between
 * two rings, the floor is nearer than where the upper one meets it.
 */
const LEAST_CELLS = 5;

export class RangePicture {
  /** Metres; 0 where nothing was seen. */
  readonly #nearest = new Float32Array(SIDE * SIDE);

  clear(): void {
    this.#nearest.fill(0);
  }

  /** Something is seen at this place in the sensor's frame, `range` metres away. */
  add(x: number, y: number, z: number, range: number): void {
    const cell = cellOf(x, y, z);
    const before = this.#nearest[cell] as number;
    if (before === 0 || range < before) this.#nearest[cell] = range;
  }

  /** The range of what is seen in this direction; 0 if unknown. */
  at(x: number, y: number, z: number): number {
    return this.#nearest[cellOf(x, y, z)] as number;
  }

  /** The least range of what is seen in this direction and beside it; 0 if too little is known of it. */
  nearestAround(x: number, y: number, z: number): number {
    const cell = cellOf(x, y, z);
    const [column, row] = [cell % SIDE, (cell - (cell % SIDE)) / SIDE];
    // The map's edges meet behind the sensor.
    if (column === 0 || row === 0 || column === SIDE - 1 || row === SIDE - 1) return 0;
    let cells = 0;
    let least = Number.POSITIVE_INFINITY;
    for (let from = cell - SIDE - 1; from <= cell + SIDE - 1; from += SIDE) {
      for (let at = from; at < from + 3; at++) {
        const range = this.#nearest[at] as number;
        if (range === 0) continue;
        cells++;
        if (range < least) least = range;
      }
    }
    return cells < LEAST_CELLS ? 0 : least;
  }
}

/** z, along which a camera looks, is in the map's middle. */
function cellOf(x: number, y: number, z: number): number {
  const scale = 1 / (Math.abs(x) + Math.abs(y) + Math.abs(z));
  let u = x * scale;
  let v = y * scale;
  if (z < 0) {
    const folded = (1 - Math.abs(v)) * (u < 0 ? -1 : 1);
    v = (1 - Math.abs(u)) * (v < 0 ? -1 : 1);
    u = folded;
  }
  const column = Math.min(Math.floor((u * 0.5 + 0.5) * SIDE), SIDE - 1);
  const row = Math.min(Math.floor((v * 0.5 + 0.5) * SIDE), SIDE - 1);
  return row * SIDE + column;
}
