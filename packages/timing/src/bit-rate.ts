/** Bits per second. 1 Mbit/s is 10⁶ bit/s. */
export type BitRate = number;

const BITS_A_BYTE = 8;
const MS_A_SECOND = 1000;
const BITS_A_MEGABIT = 1e6;

/** The only place that converts between bytes, bits, milliseconds and megabits. */
export const BitRate = {
  fromMbps(mbps: number): BitRate {
    return mbps * BITS_A_MEGABIT;
  },

  toMbps(rate: BitRate): number {
    return rate / BITS_A_MEGABIT;
  },

  /** The rate of this many bytes in this time. */
  of(bytes: number, ms: number): BitRate {
    return (bytes * BITS_A_BYTE * MS_A_SECOND) / ms;
  },

  fromBytesPerSecond(bytesPerSecond: number): BitRate {
    return bytesPerSecond * BITS_A_BYTE;
  },

  toBytesPerSecond(rate: BitRate): number {
    return rate / BITS_A_BYTE;
  },

  /** How many bytes this rate carries in this time. */
  bytesIn(rate: BitRate, ms: number): number {
    return (rate * ms) / (BITS_A_BYTE * MS_A_SECOND);
  },

  /** How long this many bytes take at this rate, ms. */
  msFor(rate: BitRate, bytes: number): number {
    return (bytes * BITS_A_BYTE * MS_A_SECOND) / rate;
  },
} as const;
