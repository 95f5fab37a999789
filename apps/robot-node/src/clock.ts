/**
 * The robot's clock: monotonic milliseconds. Unlike `performance.now()` it has the same origin in every thread of this
 * machine, so that a frame captured in the worker can be aged in the main thread.
 */
export function monotonicMs(): number {
  const [seconds, nanoseconds] = process.hrtime();
  return seconds * 1000 + nanoseconds / 1e6;
}

/** A source of robot time, ms; tests inject their own. */
export type Clock = () => number;
