import { FREE, type MotionBound, type MotionGuard } from './motion-guard.ts';
import type { OperatorView } from './operator-view.ts';

export interface ViewAgeLimits {
  /** From this age on of what the driver sees, the robot is slower, ms. */
  slowMs: number;
  /** At this age it brakes, ms; above `slowMs`. */
  brakeMs: number;
  /** A picture that is overdue by so much is as bad as one of the age `slowMs`, ms. */
  stallMs: number;
}

/**
 * What a picture that was late within the last second leaves of the speed. Chosen: it slows down and does not
 * stop, so that a link that stutters can be driven over; view-age.test.ts holds it.
 */
const MIN_FACTOR = 0.25;

const UNKNOWN: Readonly<MotionBound> = Object.freeze({ factor: 0, reason: 'view-unknown', urgent: true });
const LOST: Readonly<MotionBound> = Object.freeze({ factor: 0, reason: 'view-lost', urgent: true });

/** Motion needs a picture: the older what the driver sees, the slower the robot. */
export class ViewAge implements MotionGuard {
  readonly #view: OperatorView;
  readonly #limits: Readonly<ViewAgeLimits>;
  readonly #late: MotionBound = { factor: 1, reason: 'view-late', urgent: false };

  constructor(view: OperatorView, limits: ViewAgeLimits) {
    this.#view = view;
    this.#limits = Object.freeze({ ...limits });
  }

  bound(_wish: unknown, nowMs: number): Readonly<MotionBound> {
    const ageMs = this.#view.ageMs(nowMs);
    const worstMs = this.#view.worstAgeMs(nowMs);
    if (ageMs === null || worstMs === null) return UNKNOWN;
    const { slowMs, brakeMs, stallMs } = this.#limits;
    // On a fast link, pictures that no longer come are noticed before they are old.
    const presentMs = Math.max(ageMs, slowMs + this.#view.overdueMs(nowMs) - stallMs);
    if (presentMs >= brakeMs) return LOST;
    if (presentMs <= slowMs && worstMs <= slowMs) return FREE;
    const present = (brakeMs - presentMs) / (brakeMs - slowMs);
    // One late picture must not stop the robot for a second: only the present age can.
    const recent = Math.max(MIN_FACTOR, (brakeMs - worstMs) / (brakeMs - slowMs));
    this.#late.factor = Math.min(1, present, recent);
    return this.#late;
  }
}
