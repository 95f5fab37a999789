/** When each packet arrived, for measurements: joined with the sender's log by frame and offset it gives delivery times. */
import type { Batch } from '@farpoint/operator';

const FIELDS = 3;

export class PacketRecord {
  readonly #values: Float64Array;
  #count = 0;

  /** @param capacity packets; those after it are not recorded */
  constructor(capacity: number) {
    this.#values = new Float64Array(capacity * FIELDS);
  }

  /** @param timeOriginMs of the clock in which arrivals are to be told */
  add(batch: Batch, timeOriginMs: number): void {
    for (let packet = 0; packet < batch.packets; packet++) {
      const at = this.#count * FIELDS;
      if (at >= this.#values.length) return;
      this.#values[at] = batch.frameNumber(packet);
      this.#values[at + 1] = batch.sequenceOffset(packet);
      this.#values[at + 2] = batch.receivedAtMs(packet) - timeOriginMs;
      this.#count++;
    }
  }

  /** Frame number, sequence offset and arrival (ms), packet after packet. */
  get values(): Float64Array {
    return this.#values.subarray(0, this.#count * FIELDS);
  }
}
