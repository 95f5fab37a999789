/**
 * Which numbers (TSN, RFC 9260 §3.3.1) of an association have arrived: all up to `last`, and some of the next
 * {@link MAX_AHEAD}. A ring of bits, so that a gap costs nothing while it is open, however many numbers wait behind it.
 */

/** How far ahead of the last number received in order a number may be. */
export const MAX_AHEAD = 4096;
const MASK = MAX_AHEAD - 1;
/** More than half of all numbers ahead is behind (RFC 1982). */
const BEHIND = 2 ** 31;

export class TsnWindow {
  readonly #bits = new Uint32Array(MAX_AHEAD / 32);
  #last: number;
  /** Numbers beyond `last` that have arrived. */
  #ahead = 0;

  /** @param last every number up to it counts as received */
  constructor(last: number) {
    this.#last = last >>> 0;
  }

  /** The last number that was received in order. */
  get last(): number {
    return this.#last;
  }

  /** Whether some number before a received one is missing. */
  get hasGaps(): boolean {
    return this.#ahead > 0;
  }

  has(tsn: number): boolean {
    const ahead = (tsn - this.#last) >>> 0;
    if (ahead === 0 || ahead >= BEHIND) return true;
    return ahead <= MAX_AHEAD && this.#isSet(tsn);
  }

  /** @returns false if the number has been received before, or is too far ahead */
  add(tsn: number): boolean {
    if ((tsn - this.#last) >>> 0 > MAX_AHEAD || this.has(tsn)) return false;
    const bit = tsn & MASK;
    this.#bits[bit >> 5] = (this.#bits[bit >> 5] as number) | (1 << (bit & 31));
    this.#ahead++;
    this.#advance();
    return true;
  }

  /** The peer gives up every number up to this one (RFC 3758 §3.6). @returns false if that is nothing new */
  skipTo(tsn: number): boolean {
    const ahead = (tsn - this.#last) >>> 0;
    if (ahead === 0 || ahead >= BEHIND) return false;
    if (ahead >= MAX_AHEAD) {
      this.#bits.fill(0);
      this.#ahead = 0;
      this.#last = tsn >>> 0;
      return true;
    }
    while (this.#last !== tsn >>> 0) this.#step();
    this.#advance();
    return true;
  }

  /**
   * What has arrived beyond `last`, as the gap blocks of a SACK state it: first and last of each block, relative to
   * `last`, the nearest first.
   */
  blocks(most: number): [start: number, end: number][] {
    const blocks: [number, number][] = [];
    let left = this.#ahead;
    for (let ahead = 1; left > 0; ahead++) {
      if (!this.#isSet(this.#last + ahead)) continue;
      left--;
      const block = blocks.at(-1);
      if (block !== undefined && block[1] === ahead - 1) block[1] = ahead;
      else if (blocks.length === most) break;
      else blocks.push([ahead, ahead]);
    }
    return blocks;
  }

  #isSet(tsn: number): boolean {
    const bit = tsn & MASK;
    return (((this.#bits[bit >> 5] as number) >>> (bit & 31)) & 1) === 1;
  }

  /** Passes what follows without a gap. */
  #advance(): void {
    while (this.#ahead > 0 && this.#isSet(this.#last + 1)) this.#step();
  }

  #step(): void {
    this.#last = (this.#last + 1) >>> 0;
    if (!this.#isSet(this.#last)) return;
    const bit = this.#last & MASK;
    this.#bits[bit >> 5] = (this.#bits[bit >> 5] as number) & ~(1 << (bit & 31));
    this.#ahead--;
  }
}
