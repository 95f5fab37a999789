import type { CellRectangle } from './floor-layer.ts';
import type { FloorMap } from './floor-map.ts';
import type { FloorPose } from './sensor-grid.ts';

/**
 * What is known of all cells around a robot. Keeps its buffer: nothing is allocated for each of so many cells, some of them
 * fifty times a second.
 */
export class FloorAround {
  /** The cells that were read. */
  readonly cells: Readonly<CellRectangle>;
  /** What each is, row by row from the lowest. */
  classes = new Uint8Array(0);
  readonly #map: FloorMap;
  readonly #cells: CellRectangle = { left: 0, low: 0, width: 0, height: 0 };

  constructor(map: FloorMap) {
    this.#map = map;
    this.cells = this.#cells;
  }

  /**
   * Reads the square of cells that are no farther along each axis than this from a pose.
   *
   * @param reach metres @param travel how far the robot has gone by now, metres
   */
  read({ x, y }: Readonly<FloorPose>, reach: number, nowMs: number, travel: number): void {
    const map = this.#map;
    const cells = this.#cells;
    cells.left = map.cellOf(x - reach);
    cells.low = map.cellOf(y - reach);
    cells.width = map.cellOf(x + reach) - cells.left + 1;
    cells.height = map.cellOf(y + reach) - cells.low + 1;
    const count = cells.width * cells.height;
    if (this.classes.length < count) this.classes = new Uint8Array(count);
    map.read(cells, nowMs, travel, this.classes);
  }
}
