import { PAINTED_HINT_MS } from '@farpoint/protocol';

/** Which sensors' clouds an operator's page paints with videos, by what it last said. Time is an argument. */
export class PaintedHints {
  #sensors: ReadonlySet<number> = new Set();
  #saidMs = Number.NEGATIVE_INFINITY;

  take(sensors: readonly number[], nowMs: number): void {
    this.#sensors = new Set(sensors);
    this.#saidMs = nowMs;
  }

  /** What was said long ago no longer counts. */
  has(sensor: number, nowMs: number): boolean {
    return nowMs - this.#saidMs < PAINTED_HINT_MS && this.#sensors.has(sensor);
  }
}
