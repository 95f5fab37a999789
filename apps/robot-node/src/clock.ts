/**
 * The robot's clock: monotonic milliseconds. Unlike `performance.now()`, it has the same origin in every thread of
 * this machine, so that the main thread can compute the age of a frame captured in the worker.
 */
export function monotonicMs(): number {
  const [seconds, nanoseconds] = process.hrtime();
  return seconds * 1000 + nanoseconds / 1e6;
}

/** Processor time of the calling thread, ms. It excludes time in which other threads had the processor. */
export function threadCpuMs(): number {
  const { user, system } = process.threadCpuUsage();
  return (user + system) / 1000;
}

/** A source of robot time, ms. Tests inject their own. */
export type Clock = () => number;
