import { type CellRectangle, FloorLayer, type FloorMemory } from './floor-layer.ts';
import { floorClasses, type SensorGrid } from './sensor-grid.ts';

export interface FloorMapOptions extends FloorMemory {
  cellM: number;
  /** How many sensors see one plane only. */
  planes?: number;
  /** Whether floor over which such a sensor sees nothing counts as free where no other sees it. */
  planesShowFloor?: boolean;
}

/**
 * What all sensors together say about the floor around the robot. Those that see the floor and everything on it form one
 * layer. Each that sees one plane only has a layer of its own, because it cannot take away what it cannot see: it adds
 * obstacles, and removes only those that it has itself added.
 */
export class FloorMap {
  readonly cellM: number;
  readonly #floor: FloorLayer;
  readonly #planes: readonly FloorLayer[];
  readonly #planesShowFloor: boolean;
  #placed = true;
  #said = new Uint8Array(0);

  constructor(options: FloorMapOptions) {
    this.cellM = options.cellM;
    this.#floor = new FloorLayer(options);
    this.#planes = Array.from({ length: options.planes ?? 0 }, () => new FloorLayer(options));
    this.#planesShowFloor = options.planesShowFloor ?? false;
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
    this.#floor.centreOn(x, y);
    for (const plane of this.#planes) plane.centreOn(x, y);
  }

  /** Forgets everything. */
  forget(): void {
    this.#floor.forget();
    for (const each of this.#planes) each.forget();
  }

  /**
   * Takes what a sensor says.
   *
   * @param travel how far the robot had gone when its cloud or scan was taken, metres
   * @param plane the number of the sensor among those that see one plane only; `null` for another
   */
  merge(grid: SensorGrid, travel: number, plane: number | null = null): void {
    if (grid.placed !== this.#placed) this.forget();
    this.#placed = grid.placed;
    (plane === null ? this.#floor : this.#planes[plane])?.merge(grid, travel);
  }

  /** What is known of a cell. @param travel how far the robot has gone by now, metres */
  classAt(x: number, y: number, nowMs: number, travel: number): number {
    let known = this.#floor.classAt(x, y, nowMs, travel, this.#placed);
    for (const plane of this.#planes)
      known = this.#together(known, plane.classAt(x, y, nowMs, travel, this.#placed));
    return known;
  }

  /**
   * What is known of a rectangle of cells, row by row from its lowest: as `classAt` says, without a call for each.
   *
   * @param into at least as long as the rectangle has cells
   */
  read(cells: Readonly<CellRectangle>, nowMs: number, travel: number, into: Uint8Array): void {
    this.#floor.read(cells, nowMs, travel, this.#placed, into);
    if (this.#planes.length === 0) return;
    const count = cells.width * cells.height;
    if (this.#said.length < count) this.#said = new Uint8Array(count);
    const said = this.#said;
    for (const plane of this.#planes) {
      plane.read(cells, nowMs, travel, this.#placed, said);
      for (let i = 0; i < count; i++) into[i] = this.#together(into[i] as number, said[i] as number);
    }
  }

  /** What a cell is, of which one plane says something, too. */
  #together(known: number, said: number): number {
    if (known >= floorClasses.occupied) return known;
    if (said === floorClasses.occupied) return said;
    return said === floorClasses.free && this.#planesShowFloor ? said : known;
  }

  /** How far the robot may have come nearer to what stands in a cell since it was seen, metres. */
  travelSince(x: number, y: number, nowMs: number, travel: number): number {
    if (this.#placed) return 0;
    let since = 0;
    for (const layer of [this.#floor, ...this.#planes]) {
      if (layer.classAt(x, y, nowMs, travel, false) < floorClasses.occupied) continue;
      since = Math.max(since, travel - layer.travelAt(x, y));
    }
    return since;
  }
}
