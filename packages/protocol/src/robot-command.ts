/**
 * Commands that a robot's configuration allows, as buttons: lights, horn, docking. An operator says only which of them;
 * what it does is the robot's own matter, and no message names a topic, a type or a value.
 */
import * as z from 'zod/mini';
import { displayNameSchema, uint32Schema } from './identifiers.ts';

/** The most that a robot may have. */
export const MAX_ROBOT_COMMANDS = 32;
/** What a command is named by. */
export const COMMAND_ID = /^[a-z0-9][a-z0-9-]{0,31}$/;
/** Of what a command's answer says for people, characters. */
export const COMMAND_DETAIL_LENGTH = 200;

/** Why an operator may not give a command now. */
export const commandBars = [
  'not-permitted', // the operator's grant does not let it drive
  'not-driver', // only who drives may give it
  'estop', // not while the emergency stop is latched
] as const;
/**
 * Why an operator may not give a command now.
 *
 * @useDeclaredType
 */
export type CommandBar = (typeof commandBars)[number];

/** Why a robot refused a command. */
export const commandRefusals = [
  ...commandBars,
  'unknown', // the robot has no such command
  'too-often', // more than its configuration allows
  'busy', // it has not ended since it was given before
  'stale', // it was given too long ago
] as const;
/**
 * Why a robot refused a command.
 *
 * @useDeclaredType
 */
export type CommandRefusal = (typeof commandRefusals)[number];

/** What became of a command. */
export const commandOutcomes = [
  'done', // the message was published, or the service has answered that it was done
  'refused', // nothing was done
  'failed', // what was to do it could not, or nothing is there that does it
  'timed-out', // it was given, and nothing answered: it may be done or not
] as const;
/**
 * What became of a command.
 *
 * @useDeclaredType
 */
export type CommandOutcome = (typeof commandOutcomes)[number];

/**
 * A command that the robot takes, and whether it takes it from this operator now. On the `session` channel: one message for each
 * after the welcome, and again whenever `barred` changes.
 */
export interface RobotCommand {
  /** Tells the message from others. */
  type: 'robotCommand';
  /** By which it is given. */
  id: string;
  /** For people. */
  label: string;
  /** Commands of one group belong together. For people. */
  group?: string | undefined;
  /** It is to be given only after a second press. */
  confirm?: true | undefined;
  /** Why this operator may not give it now; left out if it may. */
  barred?: CommandBar | undefined;
}

/** Gives one of the robot's commands. On the `session` channel. */
export interface CommandCall {
  type: 'callCommand';
  /** Of the {@link RobotCommand}. */
  id: string;
  /** Chosen by the operator; the answer repeats it. */
  request: number;
  /** The operator's monotonic clock at the press, ms. */
  timeMs: number;
}

/** What became of a command that this operator gave. On the `session` channel. */
export interface CommandAnswer {
  /** Tells the message from others. */
  type: 'commandAnswer';
  /** The {@link CommandCall}'s. */
  request: number;
  /** What became of it. */
  outcome: CommandOutcome;
  /** If and only if it was refused. */
  reason?: CommandRefusal | undefined;
  /** For people: what the robot's own program says of it. */
  detail?: string | undefined;
}

const commandIdSchema = z
  .string()
  .check(z.regex(COMMAND_ID, 'must be 1–32 of a–z 0–9 - beginning with a letter or digit'));

export const robotCommandSchema = z.strictObject({
  type: z.literal('robotCommand'),
  id: commandIdSchema,
  label: displayNameSchema,
  group: z.optional(displayNameSchema),
  confirm: z.optional(z.literal(true)),
  barred: z.optional(z.enum(commandBars)),
}) satisfies z.ZodMiniType<RobotCommand>;

export const commandCallSchema = z.strictObject({
  type: z.literal('callCommand'),
  id: commandIdSchema,
  request: uint32Schema,
  timeMs: z.number().check(z.minimum(0), z.maximum(Number.MAX_SAFE_INTEGER)),
}) satisfies z.ZodMiniType<CommandCall>;

export const commandAnswerSchema = z
  .strictObject({
    type: z.literal('commandAnswer'),
    request: uint32Schema,
    outcome: z.enum(commandOutcomes),
    reason: z.optional(z.enum(commandRefusals)),
    detail: z.optional(z.string().check(z.minLength(1), z.maxLength(COMMAND_DETAIL_LENGTH))),
  })
  .check(
    z.refine(({ outcome, reason }) => (outcome === 'refused') === (reason !== undefined), {
      error: 'is given if and only if it was refused',
      path: ['reason'],
    }),
  ) satisfies z.ZodMiniType<CommandAnswer>;
