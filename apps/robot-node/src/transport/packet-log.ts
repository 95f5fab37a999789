import { writeFileSync } from 'node:fs';

/** Packets kept: 25 s at 40 Mbit/s, 100 s at 10. */
const CAPACITY = 131_072;
const FIELDS = 3;

/**
 * When each of the last packets left, for measurements: joined with the receiver's log by frame and offset it gives the
 * delivery time of every packet. Fixed memory, nothing allocated per packet, the oldest are overwritten.
 */
export class PacketLog {
  readonly #path: string;
  readonly #records = new Float64Array(CAPACITY * FIELDS);
  #count = 0;

  /** @param path where {@link write} puts the log: CSV with the columns frameNumber, sequenceOffset, sentMs */
  constructor(path: string) {
    this.#path = path;
  }

  /** @param sentMs the robot's monotonic clock */
  add(frameNumber: number, sequenceOffset: number, sentMs: number): void {
    const at = (this.#count % CAPACITY) * FIELDS;
    this.#records[at] = frameNumber;
    this.#records[at + 1] = sequenceOffset;
    this.#records[at + 2] = sentMs;
    this.#count++;
  }

  write(): void {
    const first = Math.max(0, this.#count - CAPACITY);
    const lines = ['frameNumber,sequenceOffset,sentMs'];
    for (let i = first; i < this.#count; i++) {
      const at = (i % CAPACITY) * FIELDS;
      const [frameNumber, offset, sentMs] = this.#records.subarray(at, at + FIELDS) as unknown as number[];
      lines.push(`${frameNumber},${offset},${(sentMs as number).toFixed(4)}`);
    }
    writeFileSync(this.#path, `${lines.join('\n')}\n`);
  }
}
