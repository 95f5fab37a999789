/** A place to which the robot drives by its navigator, for as long as the operator who named it holds on to it. */
import * as z from 'zod/mini';
import { handleSchema, uint32Schema } from './identifiers.ts';
import { MAX_PLACE_M, placeSchema } from './planned-path.ts';

/** Names a place to which the robot is to drive. Needs the lease. On the `session` channel. */
export interface GoalRequest {
  type: 'goal';
  /** Counts up by one for each goal of this session, wraps at 2³². */
  id: number;
  /** The operator's monotonic clock at the click, ms. */
  timeMs: number;
  /** The lease under which the goal is given. */
  lease: string;
  /** In the frame of the telemetry's pose, m. */
  x: number;
  y: number;
  /** The direction in which the robot is to stand there, rad; any if it is left out. */
  yaw?: number | undefined;
}

/** Takes a goal back. On the `session` channel. */
export interface GoalCancel {
  type: 'goalCancel';
  id: number;
}

/**
 * The operator is there, sees what its stamp says, and still wants the goal. On the `control` channel, at the rate of
 * commands; without it, the robot stops.
 */
export interface GoalHold {
  type: 'goalHold';
  /** The goal's id. */
  goal: number;
  /** Counts together with that of commands. */
  sequence: number;
  /** The operator's monotonic clock, ms. */
  timeMs: number;
  lease: string;
  /** As in commands. */
  seenUs?: number | undefined;
}

/** What becomes of a goal. */
export const goalPhases = [
  'accepted', // the robot takes it, and stands: its navigator has not begun
  'driving', // its navigator leads it there
  'reached', // it is there
  'refused', // it never drove there
  'cancelled', // it no longer drives there
  'blocked', // it stopped before it was there, and no longer drives there
] as const;
/**
 * What becomes of a goal.
 *
 * @useDeclaredType
 */
export type GoalPhase = (typeof goalPhases)[number];

/** Why a goal was refused, cancelled or blocked. */
export const goalReasons = [
  // Refused:
  'off', // the robot takes no goals
  'not-permitted', // the operator's grant does not let it drive
  'not-lease-holder', // the operator does not hold the lease that it names
  'repeated', // an id not after that of the operator's last goal
  'stale', // clicked too long ago
  'rate-limited', // too many goals
  'too-far', // farther than the robot's configuration allows
  'outside-fence', // the robot may not go there
  // Refused or cancelled:
  'estop', // the emergency stop is latched
  'no-wheels', // nothing that moves the wheels takes the robot's velocities
  'no-pose', // the robot does not know where it is
  // Cancelled:
  'asked', // the operator took it back
  'replaced', // there is another goal
  'stick', // the operator drives by hand
  'silence', // the operator's page said nothing for the watchdog's time
  'lease-lost', // the operator no longer holds the lease
  'navigator-silent', // the navigator gives no velocities
  'pose-jump', // the robot's pose has jumped: the goal is no longer where it was
  // Blocked:
  'obstacle', // something is in the way
  'fence', // the edge of the area in which the robot may move
  'view', // what the operator sees is too old
  'no-progress', // it gets nowhere
] as const;
/**
 * Why a goal was refused, cancelled or blocked.
 *
 * @useDeclaredType
 */
export type GoalReason = (typeof goalReasons)[number];

/** What has become of an operator's goal. On the `session` channel. */
export interface GoalState {
  /** Tells the message from others. */
  type: 'goalState';
  /** The goal's id. */
  id: number;
  /** What has become of it. */
  state: GoalPhase;
  /** Why; if and only if it was refused, cancelled or blocked. */
  reason?: GoalReason | undefined;
}

/** What a robot says of the goals that it takes. Part of the welcome. */
export interface GoalOffer {
  /** The farthest goal that it takes, m from where it is. */
  mostM: number;
}

/** Whether the robot has done with the goal. */
export function goalHasEnded(state: GoalPhase): boolean {
  return state !== 'accepted' && state !== 'driving';
}

const timeMsSchema = z.number().check(z.minimum(0), z.maximum(Number.MAX_SAFE_INTEGER));

export const goalRequestSchema = z.strictObject({
  type: z.literal('goal'),
  id: uint32Schema,
  timeMs: timeMsSchema,
  lease: handleSchema,
  x: placeSchema,
  y: placeSchema,
  yaw: z.optional(z.number().check(z.minimum(-Math.PI), z.maximum(Math.PI))),
}) satisfies z.ZodMiniType<GoalRequest>;

export const goalCancelSchema = z.strictObject({
  type: z.literal('goalCancel'),
  id: uint32Schema,
}) satisfies z.ZodMiniType<GoalCancel>;

export const goalHoldSchema = z.strictObject({
  type: z.literal('goalHold'),
  goal: uint32Schema,
  sequence: uint32Schema,
  timeMs: timeMsSchema,
  lease: handleSchema,
  seenUs: z.optional(uint32Schema),
}) satisfies z.ZodMiniType<GoalHold>;

export const goalStateSchema = z
  .strictObject({
    type: z.literal('goalState'),
    id: uint32Schema,
    state: z.enum(goalPhases),
    reason: z.optional(z.enum(goalReasons)),
  })
  .check(
    z.refine(
      ({ state, reason }) =>
        (state === 'refused' || state === 'cancelled' || state === 'blocked') === (reason !== undefined),
      { error: 'is given if and only if it was refused, cancelled or blocked', path: ['reason'] },
    ),
  ) satisfies z.ZodMiniType<GoalState>;

export const goalOfferSchema = z.strictObject({
  mostM: z.number().check(z.positive(), z.maximum(MAX_PLACE_M)),
}) satisfies z.ZodMiniType<GoalOffer>;
