/**
 * The newest snapshot of the simulated world in memory that threads share: the base's thread writes, sensors' threads read.
 * A sequence lock: the count is odd while it is being written, and another afterwards.
 */
import {
  readSnapshot,
  SimulatedBase,
  snapshotNumbers,
  type WorldDescription,
  type WorldSnapshot,
  writeSnapshot,
} from '@farpoint/sim';

/** Where the count stands; the numbers begin after it. */
const HEADER_BYTES = 8;
/** Writing takes microseconds: a reader that met it so often has met a writer that died in it. */
const MOST_TRIES = 1000;

/** @param movers people and carts of the world */
export function makeSharedSnapshot(movers: number): SharedArrayBuffer {
  return new SharedArrayBuffer(HEADER_BYTES + snapshotNumbers(movers) * Float64Array.BYTES_PER_ELEMENT);
}

/** There is one for each memory. */
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

  /** @returns the newest one, whole; `null` before the first, and after a writer that died while it wrote */
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

/** The world as a simulated sensor sees it: the newest snapshot, or the start of the world before there is one. */
export class SharedWorld {
  readonly #reader: SnapshotReader | null;
  #newest: WorldSnapshot;

  /** @param memory left out, the robot stands at the start and nothing moves */
  constructor(world: WorldDescription, memory: SharedArrayBuffer | undefined) {
    this.#reader = memory === undefined ? null : new SnapshotReader(memory);
    this.#newest = new SimulatedBase(world).snapshot;
  }

  get newest(): WorldSnapshot {
    this.#newest = this.#reader?.read() ?? this.#newest;
    return this.#newest;
  }
}
