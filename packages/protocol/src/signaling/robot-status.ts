import * as z from 'zod/mini';
import { displayNameSchema, robotIdSchema } from '../identifiers.ts';

const count = z.int().check(z.minimum(0), z.maximum(1_000_000));
/** The latest time that a Date can hold, ms: what is later cannot be shown. */
const MAX_TIME_MS = 8.64e15;

/** What a robot does, for whoever has no session with it. */
const robotStates = [
  'free', // nobody drives
  'driven', // somebody has the lease, and may drive at any moment
  'stopped', // the emergency stop is latched
  'fault', // the wheels take no commands
] as const;
/**
 * What a robot does, for whoever has no session with it.
 *
 * @useDeclaredType
 */
export type RobotState = (typeof robotStates)[number];

/** What a robot says about itself to whoever looks at the list of robots, without a session. */
export interface RobotStatus {
  /** What it does. */
  state: RobotState;
  /** Since when, Unix time by the robot's clock, ms. */
  sinceMs: number;
  /** Charge of the battery, 0…1; absent if the robot does not know. */
  battery?: number | undefined;
  /** Who drives; absent if nobody does, or the robot does not tell names. */
  driver?: string | undefined;
  /** Operators with a session, watchers among them. */
  operators: number;
  /** Those of them whose grant lets them only watch. */
  watchers: number;
  /** How many operators there can be. */
  maxOperators: number;
  /** Alarms that are raised. */
  alarms: number;
  /** Of the robot's software; absent if it does not tell. */
  version?: string | undefined;
}

const robotStatusSchema = z.strictObject({
  state: z.enum(robotStates),
  sinceMs: z.int().check(z.minimum(0), z.maximum(MAX_TIME_MS)),
  battery: z.optional(z.number().check(z.minimum(0), z.maximum(1))),
  driver: z.optional(displayNameSchema),
  operators: count,
  watchers: count,
  maxOperators: count,
  alarms: count,
  version: z.optional(
    z.string().check(z.regex(/^[A-Za-z0-9.+_-]{1,32}$/, 'must be 1–32 of A–Z a–z 0–9 . + _ -')),
  ),
}) satisfies z.ZodMiniType<RobotStatus>;

/** From a robot, when its status has changed. */
export const robotStatusMessage = z.strictObject({
  type: z.literal('robot.status'),
  status: robotStatusSchema,
});

/** From an operator: whether it looks at the list, and wants to be told each robot's status. */
export const statusesWatch = z.strictObject({ type: z.literal('statuses.watch'), on: z.boolean() });

const statusOfRobot = z.strictObject({ id: robotIdSchema, status: robotStatusSchema });
/** What one robot says about itself. */
export interface StatusOfRobot {
  /** The robot's id at the signaling service. */
  id: string;
  /** What it has said last. */
  status: RobotStatus;
}

/** To an operator that watches: the status of every robot that has told one. */
export const statusesMessage = z.strictObject({
  type: z.literal('statuses'),
  statuses: z.array(statusOfRobot),
});

/** What has changed since the last `statuses` or `statuses.changed`. */
export const statusesChanged = z.strictObject({
  type: z.literal('statuses.changed'),
  here: z.array(statusOfRobot),
  /** Ids of robots whose status nobody knows any more. */
  gone: z.array(robotIdSchema),
});

/** The statuses after a change. The given ones are not modified. */
export function applyStatusesChanged(
  statuses: ReadonlyMap<string, RobotStatus>,
  { here, gone }: { here: readonly StatusOfRobot[]; gone: readonly string[] },
): ReadonlyMap<string, RobotStatus> {
  const changed = new Map(statuses);
  for (const id of gone) changed.delete(id);
  for (const { id, status } of here) changed.set(id, status);
  return changed;
}
