/** What the thread that hears the collision topic tells the main thread, through memory: no message waits in a queue. */

/** The newest that was heard. */
export interface CollisionHeard {
  /** Highest speed, m/s; infinity for any. */
  mostMps: number;
  atMs: number;
  publishers: number;
}

const [HEARD, MOST, AT, PUBLISHERS] = [0, 1, 2, 3];
const ANY = 0x7fffffff;
const PER_METRE = 1000;

export class CollisionCells {
  readonly memory: SharedArrayBuffer;
  readonly #cells: Int32Array;

  /** @param memory of the other thread's; new if undefined */
  constructor(memory = new SharedArrayBuffer(16)) {
    this.memory = memory;
    this.#cells = new Int32Array(memory);
  }

  /** @param mostMps what is no number stops @param atMs `monotonicMs()`, which has the same origin in every thread */
  hear(mostMps: number, atMs: number): void {
    const millimetres = mostMps > 0 ? Math.min(ANY, Math.floor(mostMps * PER_METRE)) : 0;
    // The time first: a reader between the two takes the older demand for new, for one look.
    Atomics.store(this.#cells, AT, Math.trunc(atMs) | 0);
    Atomics.store(this.#cells, MOST, millimetres);
    Atomics.store(this.#cells, HEARD, 1);
  }

  setPublishers(count: number): void {
    Atomics.store(this.#cells, PUBLISHERS, count);
  }

  /** `null` before anything was heard. Right for what is up to 24 days old. */
  read(nowMs: number): CollisionHeard | null {
    if (Atomics.load(this.#cells, HEARD) === 0) return null;
    const most = Atomics.load(this.#cells, MOST);
    const agoMs = ((Math.trunc(nowMs) | 0) - Atomics.load(this.#cells, AT)) | 0;
    return {
      mostMps: most === ANY ? Number.POSITIVE_INFINITY : most / PER_METRE,
      atMs: Math.trunc(nowMs) - agoMs,
      publishers: Atomics.load(this.#cells, PUBLISHERS),
    };
  }
}
