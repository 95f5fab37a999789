/** Buffers shared by the worker and the page. Their number is bounded, so memory is, too, if the page stops drawing. */
import { BATCH_BYTES, Batch } from './batch.ts';

export class BatchPool {
  readonly #free: ArrayBuffer[] = [];
  readonly #most: number;
  #made = 0;
  #out = 0;

  /** @param most maximum number of buffers */
  constructor(most: number) {
    this.#most = most;
  }

  /** Number of buffers that the page has. */
  get out(): number {
    return this.#out;
  }

  /** An empty batch, or `null` if all buffers are in use. */
  take(): Batch | null {
    const buffer = this.#free.pop();
    if (buffer !== undefined) return new Batch(buffer);
    if (this.#made === this.#most) return null;
    this.#made++;
    return new Batch(new ArrayBuffer(BATCH_BYTES));
  }

  /** The batch was transferred to the page. */
  sent(): void {
    this.#out++;
  }

  /** The page returned a buffer. A buffer of the wrong size is ignored. */
  giveBack(buffer: ArrayBuffer): void {
    if (buffer.byteLength !== BATCH_BYTES || this.#out === 0) return;
    this.#out--;
    this.#free.push(buffer);
  }
}
