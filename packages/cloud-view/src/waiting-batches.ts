import type { Batch } from '@farpoint/operator';

/**
 * Maximum number of batches that wait for the next display frame; beyond it the oldest are dropped. Chosen: a
 * display that stops for a second at 30 clouds a second shows the newest when it goes on. cloud/pipeline.ts
 * of the operator has buffers for them.
 */
const MAX_WAITING = 40;

/** What takes batches back. */
export interface BatchOwner {
  release(batch: Batch): void;
}

/** Batches that wait for the next display frame, in the order in which they came. */
export class WaitingBatches {
  readonly #owner: BatchOwner;
  readonly #waiting: Batch[] = [];

  constructor(owner: BatchOwner) {
    this.#owner = owner;
  }

  /** Adds a batch. Returns how many packets were dropped to make room. */
  add(batch: Batch): number {
    let dropped = 0;
    if (this.#waiting.length >= MAX_WAITING) {
      const oldest = this.#waiting.shift() as Batch;
      dropped = oldest.packets;
      this.#owner.release(oldest);
    }
    this.#waiting.push(batch);
    return dropped;
  }

  /** Hands each batch to `take`, then returns it. */
  drain(take: (batch: Batch) => void): void {
    for (const batch of this.#waiting) {
      take(batch);
      this.#owner.release(batch);
    }
    this.#waiting.length = 0;
  }
}
