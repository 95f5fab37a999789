import * as z from 'zod/mini';
import { displayNameSchema, robotIdSchema } from '../identifiers.ts';

const count = z.int().check(z.minimum(0), z.maximum(1_000_000));

/** What a robot says about itself to whoever looks at the list of robots, without a session. */
export interface RobotStatus {
  /** Charge of the battery, 0…1; absent if the robot does not know. */
  battery?: number | undefined;
  /** Whether the emergency stop is on. */
  estop: boolean;
  /** Whether the robot moves. */
  moving: boolean;
  /** Whether somebody drives, or may at any moment: somebody has the lease. */
  driven: boolean;
  /** Who that is; absent if nobody does, or the robot does not tell names. */
  driver?: string | undefined;
  /** Operators with a session. */
  operators: number;
  /** How many operators there can be. */
  maxOperators: number;
  /** Alarms that are raised. */
  alarms: number;
}

export const robotStatusSchema = z.strictObject({
  battery: z.optional(z.number().check(z.minimum(0), z.maximum(1))),
  estop: z.boolean(),
  moving: z.boolean(),
  driven: z.boolean(),
  driver: z.optional(displayNameSchema),
  operators: count,
  maxOperators: count,
  alarms: count,
}) satisfies z.ZodMiniType<RobotStatus>;

/** From a robot, whenever its status has changed. */
export const robotStatusMessage = z.strictObject({
  type: z.literal('robot.status'),
  status: robotStatusSchema,
});

/** From an operator: whether it looks at the list, and wants to be told each robot's status. */
export const statusesWatch = z.strictObject({ type: z.literal('statuses.watch'), on: z.boolean() });

const statusOfRobot = z.strictObject({ id: robotIdSchema, status: robotStatusSchema });
export interface StatusOfRobot {
  id: string;
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
