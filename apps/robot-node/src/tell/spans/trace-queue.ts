import type { FrameStations } from '../stage-board.ts';

/**
 * Of each kind, clouds and commands, at most one trace is kept in each slot of this length, ms. Chosen: five of each a second
 * show where the time goes, and with 35 spans take 13 kbit/s of a link that clouds need; all of them, 30 clouds and 40
 * commands, would take 70.
 */
export const SLOT_MS = 200;
/** Traces that wait at most. Chosen: those of a minute, in which a collector restarts; 50 kB. */
export const MOST_WAITING = 600;
/** Numbers of a trace: its kind, operator, number, sensor and points, and five instants. */
const COLUMNS = 10;
const CLOUD = 0;
const COMMAND = 1;
/** Where a row has the time at which the drive had a command. */
const WHEELS = 7;
/** Spans of a cloud, and of a command that was not refused: one for the whole, and one for each part. */
const [CLOUD_SPANS, COMMAND_SPANS] = [4, 3];

/** What spans tell of a frame that was sent. */
export interface SentFrame {
  readonly sensor: number;
  readonly frameNumber: number;
  readonly points: number;
}

/**
 * Takes when a command passed the robot's stations, ms on its clock.
 *
 * @param operator what stands for its session
 * @param wheelsMs `null`: it was refused
 */
export type TimedCommand = (
  operator: object,
  sequence: number,
  receivedMs: number,
  judgedMs: number,
  wheelsMs: number | null,
) => void;

/** A cloud that was sent to an operator. Instants are ms on the robot's clock, in order. */
export interface CloudTrace extends FrameStations {
  kind: 'cloud';
  /** Counts operators' sessions from 1. */
  operator: number;
  sensor: number;
  frame: number;
  points: number;
}

/** A command that the robot has judged. Instants are ms on the robot's clock, in order. */
export interface CommandTrace {
  kind: 'command';
  operator: number;
  sequence: number;
  receivedMs: number;
  judgedMs: number;
  /** `null`: it was refused. */
  wheelsMs: number | null;
}

export type Trace = CloudTrace | CommandTrace;

/**
 * Chooses one of each slot's clouds and commands, and keeps the newest until they are exported. Runs for each frame and
 * command, and allocates nothing for them.
 */
export class TraceQueue {
  readonly #numbers = new Float64Array(MOST_WAITING * COLUMNS);
  readonly #random: () => number;
  /** When the next cloud and the next command are chosen, ms on the robot's clock. */
  readonly #dueMs = [0, 0];
  /** Numbers of sessions that are still known, by what stands for them. */
  readonly #operators = new WeakMap<object, number>();
  #operatorCount = 0;
  #first = 0;
  #waiting = 0;
  /** Spans that gave way to newer ones since the start. */
  overwrittenSpans = 0;

  /** @param random uniform in [0, 1): where in its slot a trace is chosen, so that no sensor and no operator is always the one */
  constructor(random: () => number) {
    this.#random = random;
  }

  /** A cloud has left for an operator. @param operator what stands for its session */
  cloud(operator: object, frame: SentFrame, at: Readonly<FrameStations>): void {
    if (!this.#chooses(CLOUD, at.lastLeftMs)) return;
    const start = this.#begin(CLOUD, operator, frame.frameNumber, frame.sensor, frame.points);
    this.#instant(start, 0, at.capturedAtMs);
    this.#instant(start, 1, at.inMemoryMs);
    this.#instant(start, 2, at.readyMs);
    this.#instant(start, 3, at.firstLeftMs);
    this.#instant(start, 4, at.lastLeftMs);
  }

  /** A command was judged. @param operator what stands for its session @param wheelsMs `null`: it was refused */
  command(
    operator: object,
    sequence: number,
    receivedMs: number,
    judgedMs: number,
    wheelsMs: number | null,
  ): void {
    if (!this.#chooses(COMMAND, judgedMs)) return;
    const start = this.#begin(COMMAND, operator, sequence, 0, 0);
    this.#instant(start, 0, receivedMs);
    this.#instant(start, 1, judgedMs);
    this.#instant(start, 2, wheelsMs ?? Number.NaN);
  }

  /** The oldest that wait, which wait no longer. */
  take(most: number): Trace[] {
    const count = Math.min(most, this.#waiting);
    const traces = Array.from({ length: count }, (_, i) => this.#read((this.#first + i) % MOST_WAITING));
    this.#first = (this.#first + count) % MOST_WAITING;
    this.#waiting -= count;
    return traces;
  }

  #chooses(kind: number, nowMs: number): boolean {
    if (nowMs < (this.#dueMs[kind] as number)) return false;
    const nextSlot = Math.floor(nowMs / SLOT_MS) + 1;
    this.#dueMs[kind] = (nextSlot + this.#random()) * SLOT_MS;
    return true;
  }

  /** @returns where its instants begin */
  #begin(kind: number, operator: object, number: number, sensor: number, points: number): number {
    if (this.#waiting === MOST_WAITING) {
      this.overwrittenSpans += this.#spansOf(this.#first);
      this.#first = (this.#first + 1) % MOST_WAITING;
      this.#waiting--;
    }
    const at = ((this.#first + this.#waiting++) % MOST_WAITING) * COLUMNS;
    const numbers = this.#numbers;
    numbers[at] = kind;
    numbers[at + 1] = this.#numberOf(operator);
    numbers[at + 2] = number;
    numbers[at + 3] = sensor;
    numbers[at + 4] = points;
    return at + 5;
  }

  /** None is before the one that precedes it: clocks of sources may be a little off. */
  #instant(start: number, index: number, atMs: number): void {
    const before = index === 0 ? Number.NEGATIVE_INFINITY : (this.#numbers[start + index - 1] as number);
    this.#numbers[start + index] = Math.max(before, atMs);
  }

  #numberOf(operator: object): number {
    const known = this.#operators.get(operator);
    if (known !== undefined) return known;
    this.#operators.set(operator, ++this.#operatorCount);
    return this.#operatorCount;
  }

  #spansOf(row: number): number {
    if (this.#numbers[row * COLUMNS] === CLOUD) return CLOUD_SPANS;
    return Number.isNaN(this.#numbers[row * COLUMNS + WHEELS]) ? COMMAND_SPANS - 1 : COMMAND_SPANS;
  }

  #read(row: number): Trace {
    const at = row * COLUMNS;
    const [
      kind,
      operator = 0,
      number = 0,
      sensor = 0,
      points = 0,
      first = 0,
      second = 0,
      third = 0,
      fourth = 0,
      last = 0,
    ] = this.#numbers.subarray(at, at + COLUMNS);
    if (kind === COMMAND) {
      const wheelsMs = Number.isNaN(third) ? null : third;
      return { kind: 'command', operator, sequence: number, receivedMs: first, judgedMs: second, wheelsMs };
    }
    return {
      kind: 'cloud',
      operator,
      sensor,
      frame: number,
      points,
      capturedAtMs: first,
      inMemoryMs: second,
      readyMs: third,
      firstLeftMs: fourth,
      lastLeftMs: last,
    };
  }
}
