/** Serial number arithmetic (RFC 1982) for counters that wrap. */

/** How far `a` is ahead of `b`, −2³¹ … 2³¹−1, for 32-bit counters. */
export function sequenceDelta32(a: number, b: number): number {
  return (a - b) | 0;
}

/** How far `a` is ahead of `b`, −2¹⁵ … 2¹⁵−1, for 16-bit counters. */
export function sequenceDelta16(a: number, b: number): number {
  return ((a - b) << 16) >> 16;
}

/** Follows a wrapping 16-bit counter as a number that never wraps. */
export class SequenceUnwrapper16 {
  #last: number | null = null;

  unwrap(value: number): number {
    this.#last = this.#last === null ? value : this.#last + sequenceDelta16(value, this.#last);
    return this.#last;
  }
}
