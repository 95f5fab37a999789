/** Bits a second. 1 Mbit/s is 10⁶ bit/s. */
export type BitRate = number;

const BITS_A_BYTE = 8;
const MS_A_SECOND = 1000;
const BITS_A_MEGABIT = 1e6;

/** Bits of so many bytes. */
export function bitsOfBytes(bytes: number): number {
  return bytes * BITS_A_BYTE;
}

/** Bytes of so many bits, not rounded. */
export function bytesOfBits(bits: number): number {
  return bits / BITS_A_BYTE;
}

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

  /** Of so many bits in so long a time. */
  ofBits(bits: number, ms: number): BitRate {
    return (bits * MS_A_SECOND) / ms;
  },

  fromBytesPerSecond(bytesPerSecond: number): BitRate {
    return bytesPerSecond * BITS_A_BYTE;
  },

  toBytesPerSecond(rate: BitRate): number {
    return rate / BITS_A_BYTE;
  },

  /** The number of bytes in this time. */
  bytesIn(rate: BitRate, ms: number): number {
    return (rate * ms) / (BITS_A_BYTE * MS_A_SECOND);
  },

  /** How many bits go in so long a time. */
  bitsIn(rate: BitRate, ms: number): number {
    return (rate * ms) / MS_A_SECOND;
  },

  /** The time that this many bytes take, ms. */
  msFor(rate: BitRate, bytes: number): number {
    return (bytes * BITS_A_BYTE * MS_A_SECOND) / rate;
  },
} as const;
