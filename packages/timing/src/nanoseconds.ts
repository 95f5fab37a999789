/**
 * Nanoseconds are counted as `bigint`, as the clocks of Node and of GStreamer count them; milliseconds are numbers with
 * fraction.
 */

export const NS_PER_MS = 1e6;
const WHOLE_MS = BigInt(NS_PER_MS);

/** @returns ms with fraction: exact to what a number can hold, also of a clock that counts since 1970 */
export function msOfNs(ns: bigint): number {
  return Number(ns / WHOLE_MS) + Number(ns % WHOLE_MS) / NS_PER_MS;
}

/** @param ms with fraction */
export function nsOfMs(ms: number): bigint {
  return BigInt(Math.round(ms * NS_PER_MS));
}
