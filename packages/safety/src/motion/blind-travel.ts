import type { Twist } from '@farpoint/protocol';
import { FREE, type MotionBound, type MotionGuard } from './motion-guard.ts';
import type { OperatorView } from './operator-view.ts';

export interface BlindTravelLimits {
  /** The furthest that any part of the robot may go between what the driver sees and standing still, m. */
  mostM: number;
  /** How hard the base brakes, m/s². */
  decelerationMps2: number;
  /** From the centre of rotation to the furthest point of the robot, m. */
  radiusM: number;
}

/**
 * The highest speed at which the way while blind and the way to brake stay within a length: the positive root of
 * v · age + v² / 2a = length.
 *
 * @returns m/s
 */
export function blindSpeedMps(ageMs: number, { mostM, decelerationMps2 }: BlindTravelLimits): number {
  const ageS = Math.max(0, ageMs) / 1000;
  return decelerationMps2 * (Math.sqrt(ageS * ageS + (2 * mostM) / decelerationMps2) - ageS);
}

/** Bounds how far the robot goes without its driver seeing it: the older what the driver sees, the slower it is. */
export class BlindTravel implements MotionGuard {
  readonly #view: OperatorView;
  readonly #limits: Readonly<BlindTravelLimits>;
  readonly #bound: MotionBound = { factor: 1, reason: 'blind-travel', urgent: false };

  constructor(view: OperatorView, limits: BlindTravelLimits) {
    this.#view = view;
    this.#limits = Object.freeze({ ...limits });
  }

  /** The highest speed of any part of the robot now, m/s; `null` while the age of what the driver sees is unknown. */
  mostMps(nowMs: number): number | null {
    const ageMs = this.#view.worstAgeMs(nowMs);
    return ageMs === null ? null : blindSpeedMps(ageMs, this.#limits);
  }

  bound({ linear, angular }: Readonly<Twist>, nowMs: number): Readonly<MotionBound> {
    const mostMps = this.mostMps(nowMs);
    // What is not known at all is for ViewAge to judge.
    if (mostMps === null) return FREE;
    const fastest = Math.hypot(linear.x, linear.y) + Math.abs(angular.z) * this.#limits.radiusM;
    if (fastest <= mostMps) return FREE;
    this.#bound.factor = mostMps / fastest;
    return this.#bound;
  }
}
