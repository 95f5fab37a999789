/** The simulated robot's own navigator: straight to the goal. What is in the way, it does not know. */
import { type Twist, zeroTwist } from '@farpoint/protocol';

export interface SteerLimits {
  /** m/s and rad/s. */
  maxLinear: number;
  maxAngular: number;
}

/** Nearer to the goal than this it is there, m; and turned by less than this, rad. */
const THERE_M = 0.15;
const THERE_RAD = 0.06;
/** Farther off its way than this, it turns before it drives, rad. */
const ASKEW_RAD = 0.3;
/** Speed for a distance that is left, 1/s; rate of turning for an angle that is left, 1/s. */
const DRIVE_GAIN = 0.8;
const TURN_GAIN = 1.5;
/** Least speed, m/s; least rate of turning, rad/s. */
const CREEP_MPS = 0.1;
const CREEP_RADPS = 0.15;

/**
 * The velocity that leads from a pose to a goal: it turns towards the goal, drives there, and turns as it is to stand.
 *
 * @param goal m; yaw in rad, undefined for any
 * @param pose of base_link, m and rad
 * @returns zero when it is there
 */
export function steerTo(
  goal: { x: number; y: number; yaw?: number | undefined },
  pose: { x: number; y: number; yaw: number },
  { maxLinear, maxAngular }: SteerLimits,
): Twist {
  const twist = zeroTwist();
  const turn = (angle: number) =>
    Math.sign(angle) * Math.min(maxAngular, Math.max(CREEP_RADPS, Math.abs(angle) * TURN_GAIN));
  const distance = Math.hypot(goal.x - pose.x, goal.y - pose.y);
  if (distance <= THERE_M) {
    const left = goal.yaw === undefined ? 0 : between(pose.yaw, goal.yaw);
    if (Math.abs(left) > THERE_RAD) twist.angular.z = turn(left);
    return twist;
  }
  const askew = between(pose.yaw, Math.atan2(goal.y - pose.y, goal.x - pose.x));
  if (Math.abs(askew) > ASKEW_RAD) {
    twist.angular.z = turn(askew);
    return twist;
  }
  twist.linear.x = Math.min(maxLinear, Math.max(CREEP_MPS, distance * DRIVE_GAIN));
  twist.angular.z = Math.min(maxAngular, Math.max(-maxAngular, askew * TURN_GAIN));
  return twist;
}

/** The angle between −π and π that leads from one direction to another, rad. */
function between(from: number, to: number): number {
  return Math.atan2(Math.sin(to - from), Math.cos(to - from));
}
