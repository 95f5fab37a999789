/** Maps a stick to the geometry_msgs/Twist of base_link (REP-103: x forward, positive rotation to the left). */
import { type DriveLimits, type Twist, zeroTwist } from '@farpoint/protocol';

/** −1…1, dead zone and curve already applied. */
export interface DriveWish {
  /** Forward positive. */
  forward: number;
  /** To the left positive. */
  left: number;
}

export const REST: Readonly<DriveWish> = Object.freeze({ forward: 0, left: 0 });

/** Scales to the robot's limits. Values beyond ±1 are clamped to the limits; NaN becomes 0. */
export function toTwist(wish: DriveWish, limits: Pick<DriveLimits, 'maxLinear' | 'maxAngular'>): Twist {
  return intoTwist(wish, limits, zeroTwist());
}

/** The same, without an allocation. @param into whose other components are 0; is returned */
export function intoTwist(
  wish: DriveWish,
  limits: Pick<DriveLimits, 'maxLinear' | 'maxAngular'>,
  into: Twist,
): Twist {
  into.linear.x = unit(wish.forward) * limits.maxLinear;
  into.angular.z = unit(wish.left) * limits.maxAngular;
  return into;
}

function unit(value: number): number {
  // + 0 turns −0 into 0.
  return Number.isNaN(value) ? 0 : Math.min(Math.max(value, -1), 1) + 0;
}
