/**
 * Monotonic milliseconds with the same origin in every process of this machine, so that records of several processes
 * can be joined.
 */
export function monotonicMs(): number {
  const [seconds, nanoseconds] = process.hrtime();
  return seconds * 1000 + nanoseconds / 1e6;
}
