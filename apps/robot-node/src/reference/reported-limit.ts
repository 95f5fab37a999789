/**
 * What a reference operator's `bandwidth` reports allow. The reference system's own bridge reports the rate at which points
 * came, frame by frame: no more than was sent, and less whenever a frame was small. Taken word for word such reports would
 * draw the rate down without end. So the largest of the latest is the limit, in the unit in which they are measured: bits of
 * point data, as in the paper's equation 2.
 */
import { MAX_POINT_DATA_BYTES } from '@farpoint/protocol';

const REPORTS = 16;
/** The first ones span the connection's own beginning. */
const LEAST_REPORTS = 4;

export class ReportedLimit {
  readonly #reports = new Float64Array(REPORTS);
  readonly #wirePerPoint: number;
  #count = 0;

  /** @param wireBytesPerPacket what a full packet takes on the wire */
  constructor(wireBytesPerPacket: number) {
    this.#wirePerPoint = wireBytesPerPacket / MAX_POINT_DATA_BYTES;
  }

  /**
   * @param bitsPerSecond one report
   * @returns the limit from now on, bit/s on the wire; `null` while there is none
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
