/**
 * The robot's clock: monotonic milliseconds. Unlike `performance.now()` it has the same origin in every thread of this
 * machine, so that a frame captured in the worker can be aged in the main thread.
 */
export function monotonicMs(): number {
  const [seconds, nanoseconds] = process.hrtime();
  return seconds * 1000 + nanoseconds / 1e6;
}

/** Processor time of the calling thread, ms: what others take from it in the meantime is not its work. */
export function threadCpuMs(): number {
  const { user, system } = process.threadCpuUsage();
  return (user + system) / 1000;
}

/** A source of robot time, ms; tests inject their own. */
export type Clock = () => number;
