/** A latency barcode's time: nanoseconds as an unsigned 64-bit number in two halves. */
export interface BarcodeTime {
  /** The upper 32 bits. */
  hi: number;
  /** The lower 32 bits. */
  lo: number;
}

const HALF = 0x1_0000_0000;
const NS_PER_MS = 1_000_000;

/**
 * Nanoseconds from milliseconds with fraction, such as those since the Unix epoch. Exact, but a number of milliseconds
 * since the Unix epoch is itself only good to 0.25 µs.
 *
 * @throws {RangeError} if it is negative, not finite, or beyond 64 bits (1.8 × 10¹³ ms)
 */
export function barcodeTimeOfMs(ms: number): BarcodeTime {
  const wholeMs = Math.floor(ms);
  const upper = Math.floor(wholeMs / HALF);
  // Below 2⁵³, and so is each term.
  const lower = (wholeMs - upper * HALF) * NS_PER_MS + Math.round((ms - wholeMs) * NS_PER_MS);
  const hi = upper * NS_PER_MS + Math.floor(lower / HALF);
  if (!(ms >= 0 && hi < HALF)) throw new RangeError(`${ms} ms is no time for a barcode`);
  return { hi, lo: lower % HALF };
}

/** Milliseconds; since the Unix epoch good to 0.25 µs. */
export function msOfBarcodeTime({ hi, lo }: BarcodeTime): number {
  const rest = hi % NS_PER_MS;
  // Below 2⁵³ in the parentheses.
  return ((hi - rest) / NS_PER_MS) * HALF + (rest * HALF + lo) / NS_PER_MS;
}
