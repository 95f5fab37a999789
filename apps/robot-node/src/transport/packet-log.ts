import { writeFileSync } from 'node:fs';

/** Number of packets kept: half a minute at 40 Mbit/s. */
const DEFAULT_CAPACITY = 131_072;
const FIELDS = 3;

/**
 * Records when each of the latest packets left, for measurements. Joined with the receiver's log by frame and offset,
 * it gives the delivery time of every packet. Fixed memory, no allocation per packet; the oldest entries are
 * overwritten.
 */
export class PacketLog {
  readonly #path: string;
  readonly #records: Float64Array;
  readonly #capacity: number;
  #count = 0;

  /** @param path where {@link write} puts the log: CSV with the columns frameNumber, sequenceOffset, sentMs */
  constructor(path: string, capacity = DEFAULT_CAPACITY) {
    this.#path = path;
    this.#capacity = capacity;
    this.#records = new Float64Array(capacity * FIELDS);
  }

  /** @param sentMs on the robot's monotonic clock */
  add(frameNumber: number, sequenceOffset: number, sentMs: number): void {
    const at = (this.#count % this.#capacity) * FIELDS;
    this.#records[at] = frameNumber;
    this.#records[at + 1] = sequenceOffset;
    this.#records[at + 2] = sentMs;
    this.#count++;
  }

  write(): void {
    const first = Math.max(0, this.#count - this.#capacity);
    const lines = ['frameNumber,sequenceOffset,sentMs'];
    for (let i = first; i < this.#count; i++) {
      const at = (i % this.#capacity) * FIELDS;
      const sentMs = this.#records[at + 2] as number;
      lines.push(`${this.#records[at]},${this.#records[at + 1]},${sentMs.toFixed(4)}`);
    }
    writeFileSync(this.#path, `${lines.join('\n')}\n`);
  }
}
