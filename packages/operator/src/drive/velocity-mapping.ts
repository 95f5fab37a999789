/** Maps a stick to the geometry_msgs/Twist of base_link (REP-103: x forward, y to the left, positive rotation to the left). */
import { type DriveLimits, type Twist, zeroTwist } from '@farpoint/protocol';

/** −1…1, dead zone and curve already applied. */
export interface DriveWish {
  /** Forward positive. */
  forward: number;
  /** Turning, to the left positive. */
  left: number;
  /** Sideways, to the left positive; left out: 0. It moves only robots whose limits have `maxLateral`. */
  sideways?: number | undefined;
}

/** What a wish is scaled to. */
type WishLimits = Pick<DriveLimits, 'maxLinear' | 'maxLateral' | 'maxAngular'>;

export const REST: Readonly<DriveWish> = Object.freeze({ forward: 0, left: 0 });

/**
 * Scales to the robot's limits. Values beyond ±1 are clamped to the limits; NaN becomes 0. A planar velocity above the greater of
 * `maxLinear` and `maxLateral` is reduced to that on its arc, as the robot would.
 */
export function toTwist(wish: DriveWish, limits: WishLimits): Twist {
  return intoTwist(wish, limits, zeroTwist());
}

/** The same, without an allocation. @param into whose other components are 0; is returned */
export function intoTwist(wish: DriveWish, limits: WishLimits, into: Twist): Twist {
  const { maxLinear, maxLateral = 0, maxAngular } = limits;
  const x = unit(wish.forward) * maxLinear;
  const y = unit(wish.sideways ?? 0) * maxLateral;
  const share = Math.min(1, Math.max(maxLinear, maxLateral) / Math.hypot(x, y));
  into.linear.x = x * share;
  into.linear.y = y * share + 0;
  into.angular.z = unit(wish.left) * maxAngular * share;
  return into;
}

function unit(value: number): number {
  // + 0 turns −0 into 0.
  return Number.isNaN(value) ? 0 : Math.min(Math.max(value, -1), 1) + 0;
}
