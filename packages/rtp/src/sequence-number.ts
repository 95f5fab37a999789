/** A 16-bit number that wraps: RTP's sequence number (RFC 3550 §5.1), and the transport-wide one. */
export type SequenceNumber = number;

const SPAN = 0x1_0000;

/** Serial number arithmetic (RFC 1982) on 16 bits. Every result is 0–65535 unless stated otherwise. */
export const SequenceNumber = {
  /** The number of the packet at position `index`, counted without wrapping. */
  of(index: number): SequenceNumber {
    return index & (SPAN - 1);
  },

  /** The number `steps` after `from`; before it if `steps` is negative. */
  add(from: SequenceNumber, steps: number): SequenceNumber {
    return (from + steps) & (SPAN - 1);
  },

  next(after: SequenceNumber): SequenceNumber {
    return SequenceNumber.add(after, 1);
  },

  /** How far `a` is ahead of `b` in the shorter direction: −32768 … 32767. */
  ahead(a: SequenceNumber, b: SequenceNumber): number {
    return ((a - b) << 16) >> 16;
  },
} as const;

/** Turns a wrapping sequence number into a count that never wraps. */
export class SequenceUnwrapper {
  #last: number | null = null;

  unwrap(value: SequenceNumber): number {
    this.#last = this.#last === null ? value : this.#last + SequenceNumber.ahead(value, this.#last);
    return this.#last;
  }
}
