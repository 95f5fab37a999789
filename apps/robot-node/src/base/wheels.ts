import { isZeroTwist, type Twist, zeroTwist } from '@farpoint/protocol';
import { Watchdog } from '@farpoint/safety';
import type { Base } from './base.ts';

/**
 * Drives a base by velocities that must be repeated: without a word for the watchdog's time it stands. So it stops by itself
 * where the thread that decides hangs. Time is an argument.
 */
export class Wheels {
  /** How often silence stopped it while it was to move. */
  stops = 0;
  readonly #base: Base;
  readonly #watchdog: Watchdog;
  #twist: Twist = zeroTwist();

  constructor(base: Base, watchdogMs: number) {
    this.#base = base;
    this.#watchdog = new Watchdog(watchdogMs);
  }

  /** A word on the velocity. What was driven until now was driven under the old one. */
  apply(twist: Twist, nowMs: number): void {
    this.advance(nowMs);
    this.#twist = twist;
    this.#watchdog.feed(nowMs);
  }

  /** Lets time pass, and looks whether there was silence. */
  advance(nowMs: number): void {
    const { deadlineMs } = this.#watchdog;
    if (deadlineMs !== null && this.#watchdog.expired(nowMs)) {
      this.#base.advance(deadlineMs, this.#twist);
      if (!isZeroTwist(this.#twist)) this.stops++;
      this.#twist = zeroTwist();
      this.#watchdog.reset();
    }
    this.#base.advance(nowMs, this.#twist);
  }
}
