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

/** Why a velocity is refused; `null` if it is within the limits. */
export function outOfRange(
  twist: Twist,
  { maxLinear, maxAngular }: Pick<DriveLimits, 'maxLinear' | 'maxAngular'>,
): RejectedCommand | null {
  const axes: [name: string, value: number, limit: number, unit: string][] = [
    ['linear.x', twist.linear.x, maxLinear, 'm/s'],
    ['linear.y', twist.linear.y, 0, 'm/s'],
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

/** −limit … limit; never −0. */
export function cutTo(limit: number, value: number): number {
  return Math.min(Math.max(value, -limit), limit) + 0;
}

export function rejected(reason: CommandRejection, detail: string): RejectedCommand {
  return { accepted: false, reason, detail };
}
