/** Who pressed STOP, and who may release it. */
import * as z from 'zod/mini';
import { displayNameSchema, uint32Schema } from './identifiers.ts';

/** The kinds of stops at the robot itself. */
export const estopHolders = ['topic', 'shm', 'gpio', 'key'] as const;
/** Why a robot starts with its emergency stop latched. */
export const estopStarts = ['was-latched', 'unclean-exit', 'unreadable', 'unwritable'] as const;
/** Who releases a latch, besides supervisors. */
export const estopReleasers = [
  'driver', // whoever drives
  'latcher', // those who pressed STOP, each while it drives
  'supervisor', // nobody else
] as const;

/**
 * What an {@link EstopState} does not say. Comes just before the `estop` message that it explains. Older robots do not
 * send it, and older pages ignore it: what they must know is in `estop`.
 */
export interface EstopCause {
  /** Tells the message from others. */
  type: 'estopCause';
  /** Number of the latch that it explains. */
  latch: number;
  /** The operator who pressed STOP first, by its grant, or else what it calls itself; left out if none did. */
  pressedBy?: string | undefined;
  /** Whether the operator who gets this is among those who pressed STOP. */
  yours: boolean;
  /** The stops at the robot itself that hold it; left out if none does. */
  heldBy?: (typeof estopHolders)[number][] | undefined;
  /** Why it has been latched since the robot's start; left out if it has not. */
  start?: (typeof estopStarts)[number] | undefined;
  /** Who releases it, besides supervisors, once no stop at the robot holds it. */
  release: (typeof estopReleasers)[number];
}

export const estopCauseSchema = z.strictObject({
  type: z.literal('estopCause'),
  latch: uint32Schema,
  pressedBy: z.optional(displayNameSchema),
  yours: z.boolean(),
  heldBy: z.optional(z.array(z.enum(estopHolders)).check(z.minLength(1), z.maxLength(estopHolders.length))),
  start: z.optional(z.enum(estopStarts)),
  release: z.enum(estopReleasers),
}) satisfies z.ZodMiniType<EstopCause>;
