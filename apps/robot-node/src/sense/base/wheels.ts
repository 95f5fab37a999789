import type { Base } from '@farpoint/cloud-source';
import { isZeroTwist, type Twist, zeroTwist } from '@farpoint/protocol';
import { Watchdog } from '@farpoint/safety';

/**
 * Drives a base with velocities that must be refreshed. After the watchdog's time without one, it stops the base.
 * Thus the base stops by itself if the thread that decides hangs. Time is an argument.
 */
export class Wheels {
  /** How often the watchdog stopped the base while it was to move. */
  stops = 0;
  readonly #base: Base;
  readonly #watchdog: Watchdog;
  #twist: Twist = zeroTwist();

  constructor(base: Base, watchdogMs: number) {
    this.#base = base;
    this.#watchdog = new Watchdog(watchdogMs);
  }

  /** Takes a velocity. The time until now counts as driven with the previous one. */
  apply(twist: Twist, nowMs: number): void {
    this.advance(nowMs);
    this.#twist = twist;
    this.#watchdog.feed(nowMs);
  }

  /** Advances time, and checks the watchdog. */
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
