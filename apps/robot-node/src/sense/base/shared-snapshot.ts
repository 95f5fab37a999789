/**
 * The newest snapshot of the simulated world, in memory shared among threads. The base's thread writes it, sensors'
 * threads read it. A sequence lock protects it: the counter is odd during a write, and differs after it.
 */
import {
  readSnapshot,
  SimulatedBase,
  snapshotNumbers,
  type WorldDescription,
  type WorldSnapshot,
  writeSnapshot,
} from '@farpoint/sim';

/** The counter is in the header; the snapshot's numbers follow. */
const HEADER_BYTES = 8;
/** A write takes microseconds. After this many attempts, the writer must have died while writing. */
const MOST_TRIES = 1000;

/** @param movers number of people and carts in the world */
export function makeSharedSnapshot(movers: number): SharedArrayBuffer {
  return new SharedArrayBuffer(HEADER_BYTES + snapshotNumbers(movers) * Float64Array.BYTES_PER_ELEMENT);
}

/** Only one writer may exist per memory. */
export class SnapshotWriter {
  readonly #count: Int32Array;
  readonly #numbers: Float64Array;

  constructor(memory: SharedArrayBuffer) {
    this.#count = new Int32Array(memory, 0, 1);
    this.#numbers = new Float64Array(memory, HEADER_BYTES);
  }

  write(snapshot: WorldSnapshot): void {
    Atomics.add(this.#count, 0, 1);
    writeSnapshot(snapshot, this.#numbers);
    Atomics.add(this.#count, 0, 1);
  }
}

export class SnapshotReader {
  readonly #count: Int32Array;
  readonly #shared: Float64Array;
  readonly #copy: Float64Array;

  constructor(memory: SharedArrayBuffer) {
    this.#count = new Int32Array(memory, 0, 1);
    this.#shared = new Float64Array(memory, HEADER_BYTES);
    this.#copy = new Float64Array(this.#shared.length);
  }

  /** @returns the newest consistent snapshot; `null` before the first one, and if the writer died during a write */
  read(): WorldSnapshot | null {
    for (let i = 0; i < MOST_TRIES; i++) {
      const before = Atomics.load(this.#count, 0);
      if (before === 0) return null;
      if (before % 2 !== 0) continue;
      this.#copy.set(this.#shared);
      if (Atomics.load(this.#count, 0) === before) return readSnapshot(this.#copy);
    }
    return null;
  }
}

/** The world as a simulated sensor sees it: the newest snapshot, or the initial state before there is one. */
export class SharedWorld {
  readonly #reader: SnapshotReader | null;
  #newest: WorldSnapshot;

  /** @param memory if undefined, the robot stays at its start and nothing moves */
  constructor(world: WorldDescription, memory: SharedArrayBuffer | undefined) {
    this.#reader = memory === undefined ? null : new SnapshotReader(memory);
    this.#newest = new SimulatedBase(world).snapshot;
  }

  get newest(): WorldSnapshot {
    this.#newest = this.#reader?.read() ?? this.#newest;
    return this.#newest;
  }
}
