/**
 * A sign of life that crosses threads through memory, not through messages: a main thread that hung for a while must
 * not take the messages that wait for it for silence.
 */
export class SinkBeat {
  readonly memory: SharedArrayBuffer;
  readonly #times: Int32Array;

  /** @param memory of the other thread's; new if undefined */
  constructor(memory = new SharedArrayBuffer(8)) {
    this.memory = memory;
    this.#times = new Int32Array(memory);
  }

  /** Gives a sign of life. @param nowMs `monotonicMs()`, which has the same origin in every thread */
  beat(nowMs: number): void {
    Atomics.store(this.#times, 0, Math.trunc(nowMs) | 0);
    Atomics.store(this.#times, 1, 1);
  }

  /** Time since the last sign of life, ms; `null` before the first. Right for up to 24 days. */
  silentMs(nowMs: number): number | null {
    if (Atomics.load(this.#times, 1) === 0) return null;
    return ((Math.trunc(nowMs) | 0) - Atomics.load(this.#times, 0)) | 0;
  }
}
