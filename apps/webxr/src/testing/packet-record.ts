/**
 * Records when each packet arrived, for measurements. Joined with the sender's log by frame and offset, this gives
 * delivery times.
 */
import type { Batch } from '@farpoint/operator';

const FIELDS = 3;

export class PacketRecord {
  readonly #values: Float64Array;
  #count = 0;

  /** @param capacity number of packets; later ones are not recorded */
  constructor(capacity: number) {
    this.#values = new Float64Array(capacity * FIELDS);
  }

  /** @param timeOriginMs time origin of the clock on which arrivals are recorded, ms */
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

  /** Frame number, sequence offset and arrival (ms) of each packet, packet after packet. */
  get values(): Float64Array {
    return this.#values.subarray(0, this.#count * FIELDS);
  }
}
