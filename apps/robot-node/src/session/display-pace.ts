/** Keeps an operator's clouds to the rate that its computer draws. Time is an argument. */
import type { DrawnMost } from '../encode/plan.ts';

/** A cloud that comes earlier than it is due by this share of the interval counts as on time: captures jitter. */
const EARLY_SHARE = 0.35;

/** Of the clouds that are encoded once for everyone, chooses those for one operator. */
export class DisplayPace {
  /** The most that its computer draws; `null`: all that comes. */
  display: DrawnMost | null = null;
  /** By sensor: when the next cloud is due, ms on the clock of the captures. */
  readonly #dueMs = new Map<number, number>();

  /** @returns whether the operator gets this cloud */
  takes(sensor: number, capturedAtMs: number): boolean {
    if (this.display === null) return true;
    const intervalMs = 1000 / this.display.framesPerSecond;
    const dueMs = this.#dueMs.get(sensor) ?? capturedAtMs;
    if (capturedAtMs < dueMs - EARLY_SHARE * intervalMs) return false;
    // After a pause nothing is made up for.
    this.#dueMs.set(sensor, Math.max(dueMs, capturedAtMs - intervalMs / 2) + intervalMs);
    return true;
  }
}
