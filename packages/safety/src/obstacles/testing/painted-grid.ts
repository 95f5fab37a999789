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
    for (let j = 0; j < SIDE; j++) {
      for (let i = 0; i < SIDE; i++) {
        const [x, y] = [(this.firstX + i + 0.5) * CELL, (this.firstY + j + 0.5) * CELL];
        if (x > fromX && x < toX && y > fromY && y < toY) this.classes[j * SIDE + i] = floorClasses[kind];
      }
    }
    return this;
  }
}
