import type { Twist } from '@farpoint/protocol';
import { zeroTwist } from '@farpoint/protocol';
import type { DriveGuard } from '@farpoint/safety';
import { type SinkFault, sinkFaultWords } from './velocity-sink.ts';

/** Refresh interval, ms: well within the time of the worker's own watchdog. */
const REFRESH_MS = 40;

/**
 * Carries the guard's velocity to the wheels: immediately after a change, at the guard's own deadline, and at a fixed
 * interval, so that the wheels notice when this thread hangs.
 */
export class DriveStation {
  readonly guard: DriveGuard;
  readonly #setTwist: (twist: Twist) => void;
  readonly #now: () => number;
  readonly #refresh: NodeJS.Timeout;
  #deadline: NodeJS.Timeout | null = null;
  #halted = false;

  /** @param fault why the wheels take no velocities now */
  constructor(
    guard: DriveGuard,
    setTwist: (twist: Twist) => void,
    now: () => number,
    fault: () => SinkFault | null = () => null,
  ) {
    guard.watchWheels(() => {
      const present = fault();
      return present === null ? null : sinkFaultWords[present];
    });
    this.guard = guard;
    this.#setTwist = setTwist;
    this.#now = now;
    this.#refresh = setInterval(() => this.apply(), REFRESH_MS);
  }

  /** Call this after every change of the guard. */
  apply(): void {
    const now = this.#now();
    this.#setTwist(this.#halted ? zeroTwist() : this.guard.velocityAt(now));
    if (this.#deadline !== null) clearTimeout(this.#deadline);
    this.#deadline = null;
    const deadlineMs = this.guard.nextDeadlineMs;
    if (deadlineMs === null || deadlineMs <= now) return;
    // Timers may fire slightly early; `apply` then arms another one.
    this.#deadline = setTimeout(() => this.apply(), Math.ceil(deadlineMs - now));
  }

  /** Stops the wheels at once, for good: nothing moves them again in this run. */
  halt(): void {
    this.#halted = true;
    this.apply();
  }

  close(): void {
    clearInterval(this.#refresh);
    if (this.#deadline !== null) clearTimeout(this.#deadline);
  }
}
