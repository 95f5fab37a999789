/** How long each stage took, of the latest frames or commands. No clock here. */
import { type Distribution, distributionOf } from './sample-window.ts';

/** Rows are kept for this long, ms. Chosen: long enough to look at what has just been felt. */
export const STAGES_KEPT_MS = 30_000;
/**
 * A row of which the robot has said nothing for so long stays without its times, ms. Chosen: several of the robot's
 * intervals (at most 1 s), and a repetition on a poor path.
 */
const UNTOLD_AFTER_MS = 5000;

/** One frame, or one command. What is not known is `null`. */
export interface StageRow<Stage extends string> {
  /** The frame's number or the command's sequence number. */
  number: number;
  /** When the page was through with it, `performance.now()`, ms. */
  endedMs: number;
  /** From its beginning to its end, ms. */
  totalMs: number | null;
  /** How long each stage took, ms. All together are the total. */
  stages: Record<Stage, number | null>;
  /** Whether the robot has told its times. */
  told: boolean;
}

/** What the rows of some time have in common. */
export interface StageSummary<Stage extends string> {
  /** How many there are. */
  rows: number;
  /** Of how many the robot has told nothing, although it should have by now. */
  untold: number;
  /** Of how many the robot has told its times, but the link's is unknown, because its clock is. */
  clockless: number;
  /** From beginning to end, ms; `null` while that is not known of any. */
  totalMs: Distribution | null;
  /** Of each stage, ms; `null` while that is not known of any. */
  stages: Record<Stage, Distribution | null>;
  /** The stage that takes longest, by its median; `null` while none is known. */
  worst: Stage | null;
}

/** The latest rows in a ring. Adding one allocates nothing. */
export class StageWindow<Stage extends string> {
  readonly #stages: readonly Stage[];
  readonly #size: number;
  readonly #number: Float64Array;
  readonly #stampUs: Float64Array;
  readonly #endedMs: Float64Array;
  readonly #totalMs: Float64Array;
  readonly #told: Uint8Array;
  /** By stage, in their order; NaN for what is not known. */
  readonly #columns: readonly Float64Array[];
  #added = 0;

  /**
   * @param stages in the order in which a row passes them
   * @param size most rows that are kept
   */
  constructor(stages: readonly Stage[], size: number) {
    this.#stages = stages;
    this.#size = size;
    this.#number = new Float64Array(size);
    this.#stampUs = new Float64Array(size);
    this.#endedMs = new Float64Array(size);
    this.#totalMs = new Float64Array(size);
    this.#told = new Uint8Array(size);
    this.#columns = stages.map(() => new Float64Array(size));
  }

  /** Forgets all rows. */
  clear(): void {
    this.#added = 0;
  }

  /**
   * Adds a row, in place of the oldest if the window is full. Nothing is known of its stages.
   *
   * @param stampUs tells rows of the same number apart
   * @param totalMs NaN if it is not known
   * @returns its slot, until others have taken it
   */
  add(number: number, stampUs: number, endedMs: number, totalMs: number): number {
    const slot = this.#added++ % this.#size;
    this.#number[slot] = number;
    this.#stampUs[slot] = stampUs;
    this.#endedMs[slot] = endedMs;
    this.#totalMs[slot] = totalMs;
    this.#told[slot] = 0;
    for (const column of this.#columns) column[slot] = Number.NaN;
    return slot;
  }

  /** The slot of the newest row of this number and stamp; −1 if there is none. */
  find(number: number, stampUs: number): number {
    for (let back = 1; back <= this.#kept; back++) {
      const slot = (this.#added - back) % this.#size;
      if (this.#number[slot] === number && this.#stampUs[slot] === stampUs) return slot;
    }
    return -1;
  }

  /** Notes how long a stage took, ms; NaN if it is not known. */
  set(slot: number, stage: Stage, ms: number): void {
    const column = this.#columns[this.#stages.indexOf(stage)];
    if (column !== undefined) column[slot] = ms;
  }

  /** How long a stage took, ms; NaN if it is not known. */
  get(slot: number, stage: Stage): number {
    return this.#columns[this.#stages.indexOf(stage)]?.[slot] ?? Number.NaN;
  }

  /** When the page was through with the row, ms. */
  endedMs(slot: number): number {
    return this.#endedMs[slot] as number;
  }

  /** From its beginning to its end, ms; NaN if that is not known. */
  totalMs(slot: number): number {
    return this.#totalMs[slot] as number;
  }

  /** The robot has told the row's times. */
  tell(slot: number, totalMs: number): void {
    this.#told[slot] = 1;
    this.#totalMs[slot] = totalMs;
  }

  /** The rows of the last 30 s, the oldest first. */
  rows(nowMs: number): StageRow<Stage>[] {
    return this.#slots(nowMs, STAGES_KEPT_MS).map((slot) => ({
      number: this.#number[slot] as number,
      endedMs: this.#endedMs[slot] as number,
      totalMs: known(this.totalMs(slot)),
      stages: this.#record((stage) => known(this.get(slot, stage))),
      told: this.#told[slot] === 1,
    }));
  }

  /**
   * What the latest rows have in common.
   *
   * @param overMs of how long, at most 30 s
   */
  summary(nowMs: number, overMs = STAGES_KEPT_MS): StageSummary<Stage> {
    const slots = this.#slots(nowMs, Math.min(overMs, STAGES_KEPT_MS));
    const told = slots.filter((slot) => this.#told[slot] === 1);
    const stages = this.#record((stage) => distributionIn(slots.map((slot) => this.get(slot, stage))));
    return {
      rows: slots.length,
      untold: this.#untold(nowMs),
      clockless:
        'link' in stages ? told.filter((slot) => Number.isNaN(this.get(slot, 'link' as Stage))).length : 0,
      totalMs: distributionIn(slots.map((slot) => this.totalMs(slot))),
      stages,
      worst: longest(this.#stages, stages),
    };
  }

  get #kept(): number {
    return Math.min(this.#added, this.#size);
  }

  /** Rows that ended in the last `overMs`, the oldest first. */
  #slots(nowMs: number, overMs: number): number[] {
    const slots: number[] = [];
    for (let back = this.#kept; back > 0; back--) {
      const slot = (this.#added - back) % this.#size;
      if (this.endedMs(slot) >= nowMs - overMs) slots.push(slot);
    }
    return slots;
  }

  /** Also if only younger rows are looked at: they are not yet due. */
  #untold(nowMs: number): number {
    return this.#slots(nowMs, STAGES_KEPT_MS).filter(
      (slot) => this.#told[slot] === 0 && this.endedMs(slot) < nowMs - UNTOLD_AFTER_MS,
    ).length;
  }

  #record<Value>(of: (stage: Stage) => Value): Record<Stage, Value> {
    return Object.fromEntries(this.#stages.map((stage) => [stage, of(stage)])) as Record<Stage, Value>;
  }
}

function known(ms: number): number | null {
  return Number.isNaN(ms) ? null : ms;
}

function distributionIn(values: readonly number[]): Distribution | null {
  return distributionOf(Float64Array.from(values.filter((ms) => !Number.isNaN(ms))));
}

function longest<Stage extends string>(
  stages: readonly Stage[],
  of: Readonly<Record<Stage, Distribution | null>>,
): Stage | null {
  let worst: Stage | null = null;
  for (const stage of stages) {
    const ms = of[stage]?.p50 ?? Number.NEGATIVE_INFINITY;
    if (ms > (worst === null ? Number.NEGATIVE_INFINITY : (of[worst]?.p50 ?? 0))) worst = stage;
  }
  return worst;
}
