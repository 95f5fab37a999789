import type { Twist } from '@farpoint/protocol';
import type { DriveGuard } from '@farpoint/safety';

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

  constructor(guard: DriveGuard, setTwist: (twist: Twist) => void, now: () => number) {
    this.guard = guard;
    this.#setTwist = setTwist;
    this.#now = now;
    this.#refresh = setInterval(() => this.apply(), REFRESH_MS);
  }

  /** Call this after every change of the guard. */
  apply(): void {
    const now = this.#now();
    this.#setTwist(this.guard.velocityAt(now));
    if (this.#deadline !== null) clearTimeout(this.#deadline);
    this.#deadline = null;
    const deadlineMs = this.guard.nextDeadlineMs;
    if (deadlineMs === null || deadlineMs <= now) return;
    // Timers may fire slightly early; `apply` then arms another one.
    this.#deadline = setTimeout(() => this.apply(), Math.ceil(deadlineMs - now));
  }

  close(): void {
    clearInterval(this.#refresh);
    if (this.#deadline !== null) clearTimeout(this.#deadline);
  }
}
