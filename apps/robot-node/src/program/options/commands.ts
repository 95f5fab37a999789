/** What operators may make the robot do besides driving. Commands can be set only in the configuration file. */
import { COMMAND_ID, MAX_ROBOT_COMMANDS } from '@farpoint/protocol';
import { ros2TypeOf, SERVICE_TYPES } from '@farpoint/ros';
import { defineOption } from '@farpoint/service';
import * as z from 'zod';
import { commandGivers, recordActions, simActions } from '../../serve/commands/command-configuration.ts';

/** Chosen: lights that blink by hand, and no topic that is flooded; commands.test.ts holds it. */
const MOST_PER_SECOND = 10;
/** Chosen: a robot that docks takes minutes; commands.test.ts holds it. */
const MOST_TIMEOUT_S = 600;

const text = z
  .string('must be text')
  .min(1, 'must not be empty')
  .max(64, 'must be at most 64 characters long')
  .regex(/^\P{Cc}*$/u, 'must have no control characters');
const flag = z.boolean('must be true or false');
const name = z
  .string('must be text')
  .regex(/^(\/[A-Za-z_]\w*)+$/, 'must be a full name such as /lights')
  .max(200, 'must be at most 200 characters long');
const number = (least: number, most: number) =>
  z.number('must be a number').min(least, `must be at least ${least}`).max(most, `must be at most ${most}`);
const type = z
  .string('must be a type')
  .max(200, 'must be at most 200 characters long')
  .regex(/^[A-Za-z]\w*\/(msg\/|action\/)?[A-Za-z]\w*$/, 'must be a type such as std_msgs/Bool');
const fields = z.record(z.string(), z.unknown(), 'must be a mapping of fields').default({});

const publish = z.strictObject(
  { topic: name, type: type.transform(ros2TypeOf), message: fields },
  'must be a mapping with topic, type and message',
);

const call = z
  .strictObject(
    {
      service: name,
      type: z.enum(SERVICE_TYPES, 'must be std_srvs/Empty, std_srvs/Trigger or std_srvs/SetBool'),
      data: flag.optional(),
    },
    'must be a mapping with service and type',
  )
  .refine(({ type, data }) => (type === 'std_srvs/SetBool') === (data !== undefined), {
    error: 'is given for std_srvs/SetBool, and only there',
    path: ['data'],
  });

const goal = z.strictObject(
  {
    action: name,
    type,
    definition: z
      .string('must be the text of the goal’s definition')
      .max(10_000, 'must be at most 10000 characters long')
      .default(''),
    fields,
  },
  'must be a mapping with action, type, definition and fields',
);

const actions = {
  publish: publish.optional(),
  call: call.optional(),
  goal: goal.optional(),
  sim: z.enum(simActions, `must be ${simActions.join(', ')}`).optional(),
  record: z.enum(recordActions, `must be ${recordActions.join(', ')}`).optional(),
};

const commandSchema = z
  .strictObject(
    {
      id: z
        .string('must be text')
        .regex(COMMAND_ID, 'must be 1–32 of a–z 0–9 - beginning with a letter or digit'),
      label: text,
      group: text.optional(),
      confirm: flag.default(false),
      who: z.enum(commandGivers, `must be ${commandGivers.join(', ')}`).default('driver'),
      standing: flag.default(false),
      onStop: z.enum(['cancel', 'continue'], 'must be cancel or continue').default('cancel'),
      perSecond: number(0.01, MOST_PER_SECOND).default(1),
      timeoutS: number(0.1, MOST_TIMEOUT_S).default(5),
      ...actions,
    },
    'must be a mapping with id, label, and publish, call or goal',
  )
  .refine(
    (command) =>
      (Object.keys(actions) as (keyof typeof actions)[]).filter((key) => command[key] !== undefined)
        .length === 1,
    'must have one of publish, call, goal, record and sim',
  );

export type CommandValues = z.output<typeof commandSchema>;

export const commandsOptions = {
  commands: defineOption({
    schema: z
      .array(commandSchema, 'must be a list of commands')
      .max(MAX_ROBOT_COMMANDS, `must be at most ${MAX_ROBOT_COMMANDS} commands`)
      .refine((all) => new Set(all.map(({ id }) => id)).size === all.length, 'must name each id once'),
    default: [],
    flag: false,
    env: false,
    help: 'what operators may make the robot do by a button, and nothing else: id, label, group, confirm, who, standing, onStop, perSecond, timeoutS, and publish (a fixed message on a topic), call (a service) or goal (an action) in the robot’s ROS graph, record (start, stop, bookmark) or sim (docs/commands.md)',
  }),
};
