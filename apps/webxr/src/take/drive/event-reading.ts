/** When what a device reports by events was last known to be its state. Pure: time is an argument. */
import { READING_HOLDS_MS } from '@farpoint/operator';

/**
 * Keys and fingers send events only when they change. What is down stays so as long as the page runs, for it would have
 * heard otherwise. After a hitch the news may still wait in the browser's queue, behind the timer that finds the page
 * running again: the state counts as known from the next turn on.
 */
export class EventReading {
  /** `performance.now()` of the latest reading. */
  readMs = Number.NEGATIVE_INFINITY;
  #ranMs = Number.NEGATIVE_INFINITY;

  /** Call this many times a second while the page runs. @param nowMs `performance.now()` */
  runs(nowMs: number): void {
    const hitched = !(nowMs - this.#ranMs <= READING_HOLDS_MS);
    this.#ranMs = nowMs;
    if (!hitched) this.readMs = nowMs;
  }

  /** An event told the state. @param nowMs of now, not of the event */
  told(nowMs: number): void {
    this.readMs = nowMs;
  }
}
