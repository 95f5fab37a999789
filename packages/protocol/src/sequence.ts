/**
 * Serial number arithmetic (RFC 1982) for 32-bit counters that wrap: frames, commands, reports.
 *
 * @returns how far `a` is ahead of `b`, −2³¹ … 2³¹−1
 */
export function sequenceDelta32(a: number, b: number): number {
  return (a - b) | 0;
}
