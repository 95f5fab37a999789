/** What the thread that hears a stop topic tells the main thread, through memory: no message waits in a queue. */

/** The newest that was heard. */
export interface StopHeard {
  /** How many messages said stop; wraps. One between two looks is not missed. */
  stops: number;
  stop: boolean;
  atMs: number;
  publishers: number;
}

const [HEARD, STOPS, STOP, AT, PUBLISHERS] = [0, 1, 2, 3, 4];

export class StopCells {
  readonly memory: SharedArrayBuffer;
  readonly #cells: Int32Array;

  /** @param memory of the other thread's; new if undefined */
  constructor(memory = new SharedArrayBuffer(20)) {
    this.memory = memory;
    this.#cells = new Int32Array(memory);
  }

  /** @param atMs `monotonicMs()`, which has the same origin in every thread */
  hear(stop: boolean, atMs: number): void {
    Atomics.store(this.#cells, STOP, stop ? 1 : 0);
    if (stop) Atomics.add(this.#cells, STOPS, 1);
    Atomics.store(this.#cells, AT, Math.trunc(atMs) | 0);
    Atomics.store(this.#cells, HEARD, 1);
  }

  setPublishers(count: number): void {
    Atomics.store(this.#cells, PUBLISHERS, count);
  }

  /** `null` before anything was heard. Right for what is up to 24 days old. */
  read(nowMs: number): StopHeard | null {
    if (Atomics.load(this.#cells, HEARD) === 0) return null;
    const agoMs = ((Math.trunc(nowMs) | 0) - Atomics.load(this.#cells, AT)) | 0;
    const stop = Atomics.load(this.#cells, STOP) !== 0;
    const stops = Atomics.load(this.#cells, STOPS);
    return {
      stops,
      stop,
      atMs: Math.trunc(nowMs) - agoMs,
      publishers: Atomics.load(this.#cells, PUBLISHERS),
    };
  }
}
