/**
 * The newest grid of a sensor, in memory shared between its capture thread and the main thread. Three slots: one that is
 * written, one that is read, one between them that is exchanged. Nobody waits, and nothing is copied twice.
 */
import type { SensorGrid } from '@farpoint/safety';

/** The slot between, and whether it is newer than the one that is read. */
const HEADER_BYTES = 8;
const SLOTS = 3;
const SLOT_MASK = 3;
const FRESH = 4;
/** Where each fact of a grid is in its slot. */
const FACT = {
  capturedAtMs: 0,
  placed: 1,
  firstX: 2,
  firstY: 3,
  tookMs: 4,
  disputed: 5,
  hasHeights: 6,
} as const;
const FACTS = Object.keys(FACT).length;

export interface GridShape {
  side: number;
  cellM: number;
}

function slotBytes(side: number): number {
  return FACTS * Float64Array.BYTES_PER_ELEMENT + Math.ceil((2 * side * side) / 8) * 8;
}

export function makeSharedGrid({ side }: GridShape): SharedArrayBuffer {
  return new SharedArrayBuffer(HEADER_BYTES + SLOTS * slotBytes(side));
}

function slotsOf(memory: SharedArrayBuffer, side: number) {
  return Array.from({ length: SLOTS }, (_, slot) => {
    const begin = HEADER_BYTES + slot * slotBytes(side);
    return {
      facts: new Float64Array(memory, begin, FACTS),
      classes: new Uint8Array(memory, begin + FACTS * Float64Array.BYTES_PER_ELEMENT, side * side),
      heights: new Uint8Array(
        memory,
        begin + FACTS * Float64Array.BYTES_PER_ELEMENT + side * side,
        side * side,
      ),
    };
  });
}

export interface WrittenGrid extends Omit<SensorGrid, 'side' | 'cellM'> {
  tookMs: number;
}

/** Only one writer may exist per memory. */
export class SharedGridWriter {
  readonly #state: Int32Array;
  readonly #slots: ReturnType<typeof slotsOf>;
  #own = 1;

  constructor(memory: SharedArrayBuffer, { side }: GridShape) {
    this.#state = new Int32Array(memory, 0, 1);
    this.#slots = slotsOf(memory, side);
  }

  /** @param grid with the time that it took to make it, ms */
  write({ classes, heights, ...grid }: WrittenGrid): void {
    const { capturedAtMs, placed, firstX, firstY, tookMs, disputed = false } = grid;
    const slot = this.#slots[this.#own] as ReturnType<typeof slotsOf>[number];
    const { facts } = slot;
    facts[FACT.capturedAtMs] = capturedAtMs;
    facts[FACT.placed] = Number(placed);
    facts[FACT.firstX] = firstX;
    facts[FACT.firstY] = firstY;
    facts[FACT.tookMs] = tookMs;
    facts[FACT.disputed] = Number(disputed);
    facts[FACT.hasHeights] = Number(heights !== undefined);
    slot.classes.set(classes);
    if (heights !== undefined) slot.heights.set(heights);
    this.#own = Atomics.exchange(this.#state, 0, this.#own | FRESH) & SLOT_MASK;
  }
}

/** Only one reader may exist per memory. */
export class SharedGridReader {
  /** How many grids were read, and how long it took to make the last, ms. */
  readonly count = { grids: 0, lastMs: 0 };
  readonly #state: Int32Array;
  readonly #slots: ReturnType<typeof slotsOf>;
  readonly #shape: GridShape;
  #own = 2;

  constructor(memory: SharedArrayBuffer, shape: GridShape) {
    this.#state = new Int32Array(memory, 0, 1);
    this.#slots = slotsOf(memory, shape.side);
    this.#shape = shape;
  }

  /** @returns the newest grid, valid until the next call; `null` if there is none since the last */
  read(): SensorGrid | null {
    if ((Atomics.load(this.#state, 0) & FRESH) === 0) return null;
    this.#own = Atomics.exchange(this.#state, 0, this.#own) & SLOT_MASK;
    const { facts, classes, heights } = this.#slots[this.#own] as ReturnType<typeof slotsOf>[number];
    const fact = (name: keyof typeof FACT) => facts[FACT[name]] as number;
    this.count.grids++;
    this.count.lastMs = fact('tookMs');
    const grid: SensorGrid = {
      ...this.#shape,
      capturedAtMs: fact('capturedAtMs'),
      placed: fact('placed') === 1,
      disputed: fact('disputed') === 1,
      firstX: fact('firstX'),
      firstY: fact('firstY'),
      classes,
    };
    return fact('hasHeights') === 1 ? { ...grid, heights } : grid;
  }
}
