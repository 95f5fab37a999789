/**
 * The rate limit from a reference operator's `bandwidth` reports. The reference system's bridge reports the rate at
 * which points arrived, frame by frame: never more than was sent, and less whenever a frame was small. Taken
 * literally, such reports would reduce the rate without end. The limit is therefore the largest of the latest
 * reports. Their unit is bits of point data, as in the paper's equation 2.
 */
import { MAX_POINT_DATA_BYTES } from '@farpoint/protocol';

const REPORTS = 16;
/** The first reports cover the connection's own start. */
const LEAST_REPORTS = 4;

export class ReportedLimit {
  readonly #reports = new Float64Array(REPORTS);
  readonly #wirePerPoint: number;
  #count = 0;

  /** @param wireBytesPerPacket size of a full packet on the wire, bytes */
  constructor(wireBytesPerPacket: number) {
    this.#wirePerPoint = wireBytesPerPacket / MAX_POINT_DATA_BYTES;
  }

  /**
   * @param bitsPerSecond one report
   * @returns the new limit, bit/s on the wire; `null` while there is none
   */
  add(bitsPerSecond: number): number | null {
    this.#reports[this.#count % REPORTS] = bitsPerSecond;
    this.#count++;
    if (this.#count < LEAST_REPORTS) return null;
    const filled = Math.min(this.#count, REPORTS);
    let largest = 0;
    for (let i = 0; i < filled; i++) largest = Math.max(largest, this.#reports[i] as number);
    return largest * this.#wirePerPoint;
  }
}
