/** Who pressed STOP, why else the robot stands, and who may release it. */
import * as z from 'zod/mini';
import { displayNameSchema, uint32Schema } from './identifiers.ts';

/** The kinds of stops at the robot itself. */
export const robotStops = ['topic', 'shm', 'gpio', 'key'] as const;
/**
 * A kind of stop at the robot itself.
 *
 * @useDeclaredType
 */
export type RobotStop = (typeof robotStops)[number];

/** Why a robot starts with its emergency stop latched. */
export const estopStarts = [
  'was-latched', // when the last run ended
  'unclean-exit', // the last run did not end in order
  'unreadable', // what the last run left cannot be read
  'unwritable', // nothing can be remembered, so that the next start could not tell a crash
] as const;
/**
 * Why a robot starts with its emergency stop latched.
 *
 * @useDeclaredType
 */
export type EstopStart = (typeof estopStarts)[number];

/** Who may release an emergency stop that an operator has latched. Supervisors always may. */
export const estopReleasePolicies = [
  'driver', // whoever drives
  'latcher', // the operator who latched it, in any of its sessions, while it drives
  'supervisor', // supervisors only
] as const;
/**
 * Who may release an emergency stop that an operator has latched. Supervisors always may.
 *
 * @useDeclaredType
 */
export type EstopReleasePolicy = (typeof estopReleasePolicies)[number];

/**
 * What an {@link EstopState} does not say. Comes just before each `estop` message that says `latched`. Older robots do not
 * send it, and older pages ignore it: what they must know is in `estop`.
 */
export interface EstopCause {
  type: 'estopCause';
  /** Number of the latch that it explains. */
  latch: number;
  /** The operator who pressed STOP first, by its grant, or else what it calls itself; left out if none did. */
  pressedBy?: string | undefined;
  /** Whether the operator who gets this is among those who pressed STOP. */
  yours: boolean;
  /** The stops at the robot itself that hold it; left out if none does. */
  heldBy?: RobotStop[] | undefined;
  /** Why it has been latched since the robot's start; left out if it has not. */
  start?: EstopStart | undefined;
  /** Who releases it now, besides supervisors, once no stop at the robot holds it. */
  release: EstopReleasePolicy;
}

export const estopCauseSchema = z.strictObject({
  type: z.literal('estopCause'),
  latch: uint32Schema,
  pressedBy: z.optional(displayNameSchema),
  yours: z.boolean(),
  heldBy: z.optional(z.array(z.enum(robotStops)).check(z.minLength(1), z.maxLength(robotStops.length))),
  start: z.optional(z.enum(estopStarts)),
  release: z.enum(estopReleasePolicies),
}) satisfies z.ZodMiniType<EstopCause>;
