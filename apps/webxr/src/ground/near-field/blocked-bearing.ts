/** Where the robot is not let go, as far as its driver's hand leads it. */
import type { MotionState, Twist } from '@farpoint/protocol';

/** What stands, or must count as standing, in the way. */
const BLOCKING: ReadonlySet<MotionState['reasons'][number]> = new Set([
  'obstacle',
  'drop-off',
  'collision-topic',
  'collision-silent',
  'fence',
]);
/**
 * How far along its arc the direction is taken, s. Chosen: farther, a turn on the spot would point behind.
 */
const AHEAD_S = 0.5;

/**
 * The direction in which the robot is held, radians to the left of straight ahead; `null` if it is not held.
 *
 * @param asked what its driver asks for; `null` if nobody here drives it
 */
export function blockedBearing(
  asked: Readonly<Twist> | null,
  motion: Readonly<MotionState> | undefined,
): number | null {
  if (asked === null || motion === undefined || motion.factor > 0) return null;
  if (!motion.reasons.some((reason) => BLOCKING.has(reason))) return null;
  const { linear, angular } = asked;
  if (linear.x === 0 && linear.y === 0) return angular.z === 0 ? null : (Math.sign(angular.z) * Math.PI) / 2;
  return Math.atan2(linear.y + linear.x * angular.z * AHEAD_S, linear.x);
}
