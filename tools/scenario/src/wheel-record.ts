import type { Command, Twist } from '@farpoint/protocol';
import type { CommandVerdict } from '@farpoint/safety';
import type { EventLog } from './event-log.ts';

interface Told {
  atMs: number;
  linear: number;
  /** To the left. */
  lateral: number;
  angular: number;
  /** Until when the newest command that was accepted by then moves the robot. */
  validUntilMs: number;
}

/** What a robot's wheels are told, and what it made of each command. Times are `performance.now()`, ms. */
export class WheelRecord {
  readonly #log: EventLog;
  readonly #watchdogMs: number;
  readonly #told: Told[] = [];
  /** The highest speed that was ever asked of the wheels, m/s. */
  fastest = 0;
  /** Until when the newest accepted command moves the robot. */
  validUntilMs = 0;

  constructor(watchdogMs: number, log: EventLog) {
    this.#watchdogMs = watchdogMs;
    this.#log = log;
  }

  told({ linear: { x, y }, angular: { z } }: Twist): void {
    const atMs = performance.now();
    this.fastest = Math.max(this.fastest, Math.hypot(x, y), Math.abs(z));
    const before = this.#told.at(-1);
    if (before?.linear === x && before.lateral === y && before.angular === z) return;
    this.#told.push({ atMs, linear: x, lateral: y, angular: z, validUntilMs: this.validUntilMs });
    this.#log.add('wheels', { linear: x, ...(y === 0 ? {} : { lateral: y }), angular: z });
  }

  judged(session: string, { sequence }: Command, verdict: CommandVerdict): void {
    if (verdict.accepted) this.validUntilMs = performance.now() - verdict.spentMs + this.#watchdogMs;
    this.#log.add(verdict.accepted ? 'accepted' : verdict.reason, { session, sequence });
  }

  /** Speed ahead that the wheels were told last, m/s. */
  get speed(): number {
    return this.#told.at(-1)?.linear ?? 0;
  }

  /** Speed to the left that they were told last, m/s. */
  get lateral(): number {
    return this.#told.at(-1)?.lateral ?? 0;
  }

  /** When the wheels were first told less than at this time, and what was valid then; `null` if they were not. */
  braked(fromMs: number): { atMs: number; validUntilMs: number } | null {
    const before = this.#told.findLast(({ atMs }) => atMs <= fromMs)?.linear ?? 0;
    return this.#told.find(({ atMs, linear }) => atMs > fromMs && linear < before - 1e-9) ?? null;
  }

  /** When the wheels were first told to stand after this time; `null` if they were not. */
  stoodMs(fromMs: number): number | null {
    return this.#told.find(({ atMs, linear }) => atMs > fromMs && linear === 0)?.atMs ?? null;
  }

  /** The highest speed that they were told after this time, m/s. */
  fastestSince(fromMs: number): number {
    const since = this.#told.filter(({ atMs }) => atMs > fromMs);
    return Math.max(0, ...since.map(({ linear }) => Math.abs(linear)));
  }
}
