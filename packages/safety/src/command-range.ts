/** What a robot can be asked for. */
import type { CommandRejection, DriveLimits, Twist } from '@farpoint/protocol';

export interface RejectedCommand {
  accepted: false;
  reason: CommandRejection;
  /** For people: what is wrong and where, under 200 characters. */
  detail: string;
}

/** Relative tolerance: what a float32 or a decimal round trip may add to a limit. The excess is cut off. */
const TOLERANCE = 1e-6;

type VelocityLimits = Pick<DriveLimits, 'maxLinear' | 'maxLateral' | 'maxAngular'>;

/** Why a velocity is refused; `null` if it is within the limits. */
export function outOfRange(
  twist: Twist,
  { maxLinear, maxLateral = 0, maxAngular }: VelocityLimits,
): RejectedCommand | null {
  const axes: [name: string, value: number, limit: number, unit: string][] = [
    ['linear.x', twist.linear.x, maxLinear, 'm/s'],
    ['linear.y', twist.linear.y, maxLateral, 'm/s'],
    ['linear.z', twist.linear.z, 0, 'm/s'],
    ['angular.x', twist.angular.x, 0, 'rad/s'],
    ['angular.y', twist.angular.y, 0, 'rad/s'],
    ['angular.z', twist.angular.z, maxAngular, 'rad/s'],
  ];
  for (const [name, value, limit, unit] of axes) {
    // Written so that NaN is out of range.
    if (Math.abs(value) <= limit * (1 + TOLERANCE)) continue;
    const shown = Number(value.toPrecision(4));
    return rejected(
      'out-of-range',
      limit === 0
        ? `twist.${name} ${shown} ${unit}: the robot has no such axis`
        : `twist.${name} ${shown} ${unit} is beyond ±${limit} ${unit}`,
    );
  }
  return null;
}

/**
 * What the robot makes of a velocity that is not {@link outOfRange}: every component within its limit, and the planar velocity
 * within the greater of its two limits, on the same arc.
 */
export function cutToLimits({ linear, angular }: Twist, limits: VelocityLimits): Twist {
  const { maxLinear, maxLateral = 0, maxAngular } = limits;
  const [x, y] = [cutTo(maxLinear, linear.x), cutTo(maxLateral, linear.y)];
  const share = Math.min(1, Math.max(maxLinear, maxLateral) / Math.hypot(x, y));
  return {
    linear: { x: x * share + 0, y: y * share + 0, z: 0 },
    angular: { x: 0, y: 0, z: cutTo(maxAngular, angular.z) * share + 0 },
  };
}

/** −limit … limit; never −0. */
function cutTo(limit: number, value: number): number {
  return Math.min(Math.max(value, -limit), limit) + 0;
}

export function rejected(reason: CommandRejection, detail: string): RejectedCommand {
  return { accepted: false, reason, detail };
}
