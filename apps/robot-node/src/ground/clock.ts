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

/**
 * How often two clocks are read before what came between them is accepted. Chosen: a process that is
 * interrupted five times in a row within microseconds would be interrupted for ever.
 */
const MOST_READINGS = 5;

/**
 * Reads another clock together with this one: once more if longer than `atOnceMs` passes meanwhile, because another thread has
 * had the processor.
 */
export function readAtOnce<Time>(
  nowMs: Clock,
  other: () => Time,
  atOnceMs: number,
): { beforeMs: number; afterMs: number; time: Time } {
  let beforeMs = nowMs();
  for (let readings = 1; ; readings++) {
    const time = other();
    const afterMs = nowMs();
    if (afterMs - beforeMs <= atOnceMs || readings === MOST_READINGS) return { beforeMs, afterMs, time };
    beforeMs = afterMs;
  }
}

/** A source of robot time, ms. Tests inject their own. */
export type Clock = () => number;
