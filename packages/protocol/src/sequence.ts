/**
 * Serial number arithmetic (RFC 1982) for 32-bit counters that wrap: frames, commands, reports.
 *
 * @returns how far `a` is ahead of `b`, −2³¹ … 2³¹−1
 */
export function sequenceDelta32(a: number, b: number): number {
  return (a - b) | 0;
}

/** The counter's value after `sequence`: 0 after 2³²−1. */
export function nextSequence32(sequence: number): number {
  return (sequence + 1) >>> 0;
}

/** What a 32-bit counter reads at `count`, which counts without wrapping. */
export function sequence32Of(count: number): number {
  return count >>> 0;
}
