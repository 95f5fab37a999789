import { type Twist, zeroTwist } from '@farpoint/protocol';
import type { DriveGuard, MotionSupervisor } from '@farpoint/safety';
import { type SinkFault, sinkFaultWords } from '../../ground/velocity-sink.ts';

/**
 * Refresh interval, ms: well within the time of the worker's own watchdog, 150 ms by default. Chosen: two
 * refreshments may be missing.
 */
const REFRESH_MS = 40;
/**
 * Interval while the velocity is on its way to its target, ms. Chosen: at 4 m/s² a step is 4 cm/s, and the
 * worker looks as often; docs/safety.md counts with it.
 */
const RAMP_MS = 10;

/**
 * Carries the supervisor's velocity to the wheels: immediately after a change, at the guard's own deadline, at short
 * intervals while it ramps, and at a fixed one, so that the wheels notice when this thread hangs.
 */
export class DriveStation {
  readonly motion: MotionSupervisor;
  readonly guard: DriveGuard;
  readonly #setTwist: (twist: Twist) => void;
  readonly #now: () => number;
  readonly #refresh: NodeJS.Timeout;
  #deadline: NodeJS.Timeout | null = null;
  #halted = false;

  /** @param fault why the wheels take no velocities now */
  constructor(
    motion: MotionSupervisor,
    setTwist: (twist: Twist) => void,
    now: () => number,
    fault: () => SinkFault | null = () => null,
  ) {
    motion.guard.watchWheels(() => {
      const present = fault();
      return present === null ? null : sinkFaultWords[present];
    });
    this.motion = motion;
    this.guard = motion.guard;
    this.#setTwist = setTwist;
    this.#now = now;
    this.#refresh = setInterval(() => this.apply(), REFRESH_MS);
  }

  /** Call this after every change of the guard. */
  apply(): void {
    const now = this.#now();
    this.#setTwist(this.#halted ? zeroTwist() : this.motion.velocityAt(now));
    if (this.#deadline !== null) clearTimeout(this.#deadline);
    this.#deadline = null;
    if (this.#halted) return;
    const deadlineMs = this.guard.nextDeadlineMs;
    const untilMs = deadlineMs === null || deadlineMs <= now ? null : deadlineMs - now;
    const waitMs = this.motion.ramping ? Math.min(RAMP_MS, untilMs ?? RAMP_MS) : untilMs;
    // Timers may fire slightly early; `apply` then arms another one.
    if (waitMs !== null) this.#deadline = setTimeout(() => this.apply(), Math.ceil(waitMs));
  }

  /** Stops the wheels at once, for good: nothing moves them again in this run. */
  halt(): void {
    this.#halted = true;
    this.motion.halt();
    this.apply();
  }

  close(): void {
    clearInterval(this.#refresh);
    if (this.#deadline !== null) clearTimeout(this.#deadline);
  }
}
