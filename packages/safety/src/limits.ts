import type { DriveLimits, Twist } from '@farpoint/protocol';
import * as z from 'zod';

/**
 * Schema of the drive limits in the robot's configuration; omitted fields take their defaults. The bounds prevent a
 * typing error from switching off a protection: a watchdog of an hour is no watchdog.
 */
export const driveLimitsSchema = z.strictObject({
  /** m/s */
  maxLinear: z.number().positive().max(10).default(1),
  /** m/s; left out: 0, the base cannot go sideways */
  maxLateral: z.number().min(0).max(10).optional(),
  /** rad/s */
  maxAngular: z.number().positive().max(10).default(1.5),
  /** ms */
  watchdogMs: z.number().min(50).max(1000).default(150),
  /** 1/s */
  maxCommandsPerSecond: z.number().min(10).max(1000).default(100),
}) satisfies z.ZodType<DriveLimits>;

export const defaultDriveLimits: Readonly<DriveLimits> = Object.freeze(driveLimitsSchema.parse({}));

/**
 * A hand that holds on through a shorter gap in its commands or in what it sees need not let go, by default, ms. Long enough
 * for a hitch of a slow page, and too short for its operator to look away.
 */
export const RESUME_WITHIN_MS = 400;

export function copyTwist({ linear, angular }: Twist): Twist {
  return { linear: { ...linear }, angular: { ...angular } };
}
