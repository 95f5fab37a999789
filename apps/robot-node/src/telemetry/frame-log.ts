import { writeFileSync } from 'node:fs';
import type { ReadyFrame } from '../capture/capture-messages.ts';

/** Number of frames kept: ten minutes at 30 frames/s. */
const DEFAULT_CAPACITY = 18_000;

/**
 * Records when each of the latest frames was captured and when its packets were ready, for measurements. Joined with
 * a camera producer's log, it gives the time from the camera to the first packet. Fixed memory; the oldest entries
 * are overwritten.
 */
export class FrameLog {
  readonly #path: string;
  readonly #rows: Float64Array;
  readonly #capacity: number;
  #count = 0;

  /** @param path where {@link write} puts the log: CSV with the columns frameNumber, capturedMs, readyMs, points */
  constructor(path: string, capacity = DEFAULT_CAPACITY) {
    this.#path = path;
    this.#capacity = capacity;
    this.#rows = new Float64Array(capacity * 4);
  }

  add({ frameNumber, capturedAtMs, readyMs, points }: ReadyFrame): void {
    const at = (this.#count % this.#capacity) * 4;
    this.#rows[at] = frameNumber;
    this.#rows[at + 1] = capturedAtMs;
    this.#rows[at + 2] = readyMs;
    this.#rows[at + 3] = points;
    this.#count++;
  }

  write(): void {
    const lines = ['frameNumber,capturedMs,readyMs,points'];
    for (let i = Math.max(0, this.#count - this.#capacity); i < this.#count; i++) {
      const [frame = 0, captured = 0, ready = 0, points = 0] = this.#rows.subarray(
        (i % this.#capacity) * 4,
        (i % this.#capacity) * 4 + 4,
      );
      lines.push(`${frame},${captured.toFixed(4)},${ready.toFixed(4)},${points}`);
    }
    writeFileSync(this.#path, `${lines.join('\n')}\n`);
  }
}
