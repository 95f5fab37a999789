/** Time for the core. */
export interface Clock {
  /** Monotonic milliseconds. */
  now(): number;
  /** Calls back once, `ms` from now or later. @returns cancels it */
  after(ms: number, call: () => void): () => void;
}

export const systemClock: Clock = {
  now: () => performance.now(),
  after(ms, call) {
    const timer = setTimeout(call, ms);
    return () => clearTimeout(timer);
  },
};
