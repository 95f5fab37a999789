/**
 * Commands that a robot's configuration allows, as buttons: lights, docking, a recording. An operator sends a command's id; what
 * it does is the robot's own matter, and no message names a topic, a type or a value.
 */
import * as z from 'zod/mini';
import { displayNameSchema, uint32Schema } from './identifiers.ts';
import { type NamedOperator, namedOperatorSchema } from './present-operators.ts';

/** The most that a robot may have. Chosen: more buttons are not found in time; commands.test.ts and robot-commands.test.ts hold it. */
export const MAX_ROBOT_COMMANDS = 32;
/** What a command is named by. */
export const COMMAND_ID = /^[a-z0-9][a-z0-9-]{0,31}$/;
/** Of what a command's run says for people, characters. Chosen: two lines of a notice; the vectors hold it. */
export const COMMAND_DETAIL_LENGTH = 200;
/** Of a bookmark's text, characters. Chosen: one line that is read later; the vectors hold it. */
export const BOOKMARK_LENGTH = 120;

/** Why an operator may not give a command now. */
export const commandBars = [
  'not-permitted', // the operator's role does not let it
  'not-driver', // only who drives may give it
  'estop', // not while the emergency stop is latched
  'moving', // only while the robot stands still
] as const;
/**
 * Why an operator may not give a command now.
 *
 * @useDeclaredType
 */
export type CommandBar = (typeof commandBars)[number];

/** Why a robot refused a command, or to cancel one. */
export const commandRefusals = [
  ...commandBars,
  'unknown', // the robot has no such command, or nothing runs under this number
  'too-often', // more than its configuration allows, or than one operator may send
  'busy', // it has not ended since it was given before
  'repeated', // the operator gave this request, or a later one, already
  'stale', // it was given too long ago
  'no-text', // it takes no text
  'not-cancellable', // it cannot be cancelled once it runs
] as const;
/**
 * Why a robot refused a command, or to cancel one.
 *
 * @useDeclaredType
 */
export type CommandRefusal = (typeof commandRefusals)[number];

/** What has become of a command that was accepted. */
export const commandStates = [
  'running', // it was begun
  'done', // the message was published, or what did it says that it is done
  'failed', // what was to do it could not, or nothing is there that does it
  'cancelled', // by an operator, or by the emergency stop
  'timed-out', // nothing has answered: it may be done or not
] as const;
/**
 * What has become of a command that was accepted.
 *
 * @useDeclaredType
 */
export type CommandState = (typeof commandStates)[number];

/** What a command has to do with the robot's recordings. */
export const recordingRoles = ['start', 'stop', 'bookmark'] as const;

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
  /** It can be cancelled while it runs. */
  cancel?: true | undefined;
  /** It begins or ends the robot's recording, or adds a bookmark to it, and the page may show it as such. */
  recording?: (typeof recordingRoles)[number] | undefined;
  /** Why this operator may not give it now; left out if it may. */
  barred?: CommandBar | undefined;
}

/** What has become of a command that some operator has given. All operators are told, at its beginning and at each change. */
export interface CommandRun {
  /** Tells the message from others. */
  type: 'commandRun';
  /** Names the run; never used again while the robot runs. */
  run: number;
  /** Of the {@link RobotCommand}. */
  id: string;
  /** Who gave it. */
  by: NamedOperator;
  /** Of the {@link CommandCall}; only for the operator that gave it. */
  request?: number | undefined;
  /** What has become of it. */
  state: CommandState;
  /** How much of it is done, 0–1, while it runs and says so. */
  progress?: number | undefined;
  /** For people: what the robot's own program says of it. */
  detail?: string | undefined;
}

/** The robot has refused a command that this operator gave, or to cancel one. */
export interface CommandRefused {
  /** Tells the message from others. */
  type: 'commandRefused';
  /** Of the {@link CommandCall}; of a {@link CommandCancel}, its `run`. */
  request: number;
  /** Why. */
  reason: CommandRefusal;
}

/** How much the robot has recorded. All operators are told once a second while it records, and once when it ends. */
export interface RecordingState {
  /** Tells the message from others. */
  type: 'recording';
  /** Whether it records now. */
  on: boolean;
  /** Size of the file, bytes. */
  bytes: number;
  /** Since the recording began, s. */
  forS: number;
}

/** Gives one of the robot's commands. On the `session` channel. */
export interface CommandCall {
  /** Tells the message from others. */
  type: 'callCommand';
  /** Of the {@link RobotCommand}. */
  id: string;
  /** Chosen by the operator: larger than that of its call before. The answer repeats it. */
  request: number;
  /** The operator's monotonic clock at the press, ms. */
  timeMs: number;
  /** Of a bookmark; other commands take none. */
  text?: string | undefined;
}

/** Cancels a command that runs. On the `session` channel. Whoever may give it may cancel it. */
export interface CommandCancel {
  /** Tells the message from others. */
  type: 'cancelCommand';
  /** Of the {@link CommandRun}. */
  run: number;
}

const commandIdSchema = z
  .string()
  .check(z.regex(COMMAND_ID, 'must be 1–32 of a–z 0–9 - beginning with a letter or digit'));

/** No control characters, and none that reorder what is read. */
const PLAIN_LINE = /^[^\p{Cc}\p{Zl}\p{Zp}\u202a-\u202e\u2066-\u2069]*$/u;

export const robotCommandSchema = z.strictObject({
  type: z.literal('robotCommand'),
  id: commandIdSchema,
  label: displayNameSchema,
  group: z.optional(displayNameSchema),
  confirm: z.optional(z.literal(true)),
  cancel: z.optional(z.literal(true)),
  recording: z.optional(z.enum(recordingRoles)),
  barred: z.optional(z.enum(commandBars)),
}) satisfies z.ZodMiniType<RobotCommand>;

export const commandRunSchema = z.strictObject({
  type: z.literal('commandRun'),
  run: uint32Schema,
  id: commandIdSchema,
  by: namedOperatorSchema,
  request: z.optional(uint32Schema),
  state: z.enum(commandStates),
  progress: z.optional(z.number().check(z.minimum(0), z.maximum(1))),
  detail: z.optional(z.string().check(z.minLength(1), z.maxLength(COMMAND_DETAIL_LENGTH))),
}) satisfies z.ZodMiniType<CommandRun>;

export const commandRefusedSchema = z.strictObject({
  type: z.literal('commandRefused'),
  request: uint32Schema,
  reason: z.enum(commandRefusals),
}) satisfies z.ZodMiniType<CommandRefused>;

const countSchema = z.int().check(z.minimum(0), z.maximum(Number.MAX_SAFE_INTEGER));

export const recordingStateSchema = z.strictObject({
  type: z.literal('recording'),
  on: z.boolean(),
  bytes: countSchema,
  forS: countSchema,
}) satisfies z.ZodMiniType<RecordingState>;

export const commandCallSchema = z.strictObject({
  type: z.literal('callCommand'),
  id: commandIdSchema,
  request: uint32Schema,
  timeMs: z.number().check(z.minimum(0), z.maximum(Number.MAX_SAFE_INTEGER)),
  text: z.optional(
    z
      .string()
      .check(
        z.minLength(1),
        z.maxLength(BOOKMARK_LENGTH),
        z.regex(PLAIN_LINE, 'must have no control characters'),
      ),
  ),
}) satisfies z.ZodMiniType<CommandCall>;

export const commandCancelSchema = z.strictObject({
  type: z.literal('cancelCommand'),
  run: uint32Schema,
}) satisfies z.ZodMiniType<CommandCancel>;
