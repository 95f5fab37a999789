/** Buffers in the worker's hands and out with the page. Bounded: a page that stops drawing cannot eat the memory. */
import { BATCH_BYTES, Batch } from './batch.ts';

export class BatchPool {
  readonly #free: ArrayBuffer[] = [];
  readonly #most: number;
  #made = 0;
  #out = 0;

  /** @param most how many buffers there may be */
  constructor(most: number) {
    this.#most = most;
  }

  /** Buffers the page has. */
  get out(): number {
    return this.#out;
  }

  /** An empty batch, or `null` where all are out. */
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

  /** The page gave a buffer back; one that is not ours by its size is left out. */
  giveBack(buffer: ArrayBuffer): void {
    if (buffer.byteLength !== BATCH_BYTES || this.#out === 0) return;
    this.#out--;
    this.#free.push(buffer);
  }
}
