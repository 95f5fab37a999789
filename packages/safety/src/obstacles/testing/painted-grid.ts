import { floorClasses, type SensorGrid } from '../sensor-grid.ts';

const SIDE = 160;
const CELL = 0.05;

/** A grid around base_link as a sensor that sees everything would give it. */
export class PaintedGrid implements SensorGrid {
  readonly side = SIDE;
  readonly cellM = CELL;
  readonly classes = new Uint8Array(SIDE * SIDE).fill(floorClasses.free);
  capturedAtMs: number;
  placed = true;
  heights?: Uint8Array;
  readonly firstX: number;
  readonly firstY: number;

  /** @param x,y its middle, metres */
  constructor(capturedAtMs: number, x = 0, y = 0) {
    this.capturedAtMs = capturedAtMs;
    this.firstX = Math.floor(x / CELL) - SIDE / 2;
    this.firstY = Math.floor(y / CELL) - SIDE / 2;
  }

  /** From now on its heights are known: all of them these. */
  high(height: number): this {
    this.heights = new Uint8Array(SIDE * SIDE).fill(height);
    return this;
  }

  /** Everything in this rectangle of the plane, metres. */
  paint(kind: keyof typeof floorClasses, fromX: number, toX: number, fromY: number, toY: number): this {
    const [left, right] = cellsBetween(fromX, toX, this.firstX);
    const [low, high] = cellsBetween(fromY, toY, this.firstY);
    for (let j = low; j < high; j++) this.classes.fill(floorClasses[kind], j * SIDE + left, j * SIDE + right);
    return this;
  }
}

/** The cells of a row or column whose middles are between these, from the first to before the last. */
function cellsBetween(from: number, to: number, first: number): [number, number] {
  const isBetween = (cell: number) => (first + cell + 0.5) * CELL > from && (first + cell + 0.5) * CELL < to;
  let begin = Math.max(0, Math.floor(from / CELL) - first - 1);
  while (begin < SIDE && !isBetween(begin)) begin++;
  let end = begin;
  while (end < SIDE && isBetween(end)) end++;
  return [begin, end];
}
