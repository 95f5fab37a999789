/** Checks commands against the rest of the configuration, and encodes what they send. */
import { MAX_ROBOT_COMMANDS } from '@farpoint/protocol';
import {
  actionServices,
  actionTypes,
  fixedMessage,
  goalDefinitions,
  RosFault,
  ros2GoalDefinitions,
  ros2TypeOf,
} from '@farpoint/ros';
import type { GraphOptions } from '../../ground/ros/open-graph.ts';
import type {
  CommandAction,
  CommandOptions,
  CommandsConfiguration,
  RecordAction,
} from '../../serve/commands/command-configuration.ts';
import type { CommandValues } from './commands.ts';
import type { RobotOptionKey, RobotOptionValues } from './robot-program.ts';
import { rosKindOf } from './sink.ts';

type Refuse = (detail: string) => void;

/** @param rules where they differ from the usual ones */
const command = (
  id: string,
  label: string,
  group: string,
  action: CommandAction,
  rules: Partial<CommandOptions>,
): CommandOptions => ({
  id,
  label,
  group,
  action,
  confirm: false,
  who: 'driver',
  standing: false,
  onStop: 'continue',
  perSecond: 1,
  timeoutMs: 15_000,
  ...rules,
});

const SIM_COMMANDS: readonly CommandOptions[] = [
  command('lights', 'Lights', 'Signals', { kind: 'sim', action: 'lights' }, {}),
  command('horn', 'Horn', 'Signals', { kind: 'sim', action: 'horn' }, { who: 'drive' }),
  command(
    'self-test',
    'Self-test',
    'Service',
    { kind: 'sim', action: 'self-test' },
    { confirm: true, standing: true, onStop: 'cancel' },
  ),
];

/** Recording goes on after STOP: it keeps what STOP is about. */
function recordCommands({ recordBy, grantKeys }: RobotOptionValues): CommandOptions[] {
  const auto = grantKeys === null ? 'drive' : 'supervise';
  const who = recordBy === 'auto' ? auto : recordBy;
  const of = (id: string, label: string, action: RecordAction, rules: Partial<CommandOptions>) =>
    command(id, label, 'Recording', { kind: 'record', action }, rules);
  return [
    of('record', 'Record', 'start', { who }),
    of('record-stop', 'Stop recording', 'stop', { who }),
    of('bookmark', 'Bookmark', 'bookmark', { who: 'drive', perSecond: 5 }),
  ];
}

/** Velocities reach the robot by its motion supervisor, and in no other way. */
const VELOCITIES: ReadonlySet<string> = new Set([
  'geometry_msgs/msg/Twist',
  'geometry_msgs/msg/TwistStamped',
]);

/**
 * What operators may make the robot do; undefined if it is nothing.
 *
 * @param refuse takes what is wrong
 * @param graph the robot's graph of this kind
 */
export function toCommands(
  values: RobotOptionValues,
  refuse: (key: RobotOptionKey, detail: string) => void,
  graph: (kind: GraphOptions['kind']) => GraphOptions,
): CommandsConfiguration | undefined {
  const { commands, simCommands, record, recordFolder, recordBy, source, grantKeys } = values;
  if (simCommands && source !== 'sim') refuse('simCommands', 'needs the source sim');
  if (recordBy === 'supervise' && grantKeys === null) refuse('recordBy', 'supervise needs access.grantKeys');
  const kind = rosKindOf(values);
  const surroundings: Surroundings = { values, kind, used: topicsInUse(values), types: new Map() };
  const configured = commands.flatMap((given): CommandOptions[] => {
    const { id, timeoutS, publish: _, call: __, goal: ___, sim: ____, record: _____, ...rules } = given;
    const refuseThis = (detail: string) => refuse('commands', `${id}: ${detail}`);
    if (rules.who === 'supervise' && grantKeys === null) refuseThis('who: supervise needs access.grantKeys');
    const action = toAction(given, surroundings, refuseThis);
    return action === null ? [] : [{ ...rules, id, timeoutMs: timeoutS * 1000, action }];
  });
  const own = new Set(configured.map(({ id }) => id));
  const records = recordCommands(values).filter(
    ({ id }) => recordFolder !== null || (record !== null && id === 'bookmark'),
  );
  const others = [...records, ...(simCommands ? SIM_COMMANDS : [])].filter(({ id }) => !own.has(id));
  const all = [...configured, ...others].slice(0, MAX_ROBOT_COMMANDS);
  if (all.length === 0) return undefined;
  const needsGraph = all.some(({ action }) => action.kind !== 'sim' && action.kind !== 'record');
  return { commands: all, graph: needsGraph && kind !== null ? graph(kind) : null };
}

interface Surroundings {
  values: RobotOptionValues;
  kind: GraphOptions['kind'] | null;
  /** What each topic is used for already. */
  used: ReadonlyMap<string, string>;
  /** Of the topics, services and actions of the commands before. */
  types: Map<string, string>;
}

function toAction(command: CommandValues, around: Surroundings, refuse: Refuse): CommandAction | null {
  const { sim, record, call, publish, goal } = command;
  const { values, kind } = around;
  if (sim !== undefined) {
    if (values.source !== 'sim') refuse('sim needs the source sim');
    return { kind: 'sim', action: sim };
  }
  if (record !== undefined) {
    const isMark = record === 'bookmark';
    if (values.recordFolder === null && !(isMark && values.record !== null))
      refuse(`record: ${record} needs recording.folder${isMark ? ' or recording.file' : ''}`);
    return { kind: 'record', action: record };
  }
  if (kind === null) {
    refuse('needs a ROS graph: neither source nor sink is ROS');
    return null;
  }
  if (publish !== undefined) return toPublish(publish, kind, around, refuse);
  if (kind === 'ros2' && values.rosGraph === 'rclnodejs')
    refuse('services and actions of ROS 2 are called over DDS: set ros.graph to dds');
  if (call !== undefined) {
    if (kind === 'ros2') takeName(call.service, call.type, around, refuse);
    return { kind: 'call', ...call, data: call.data ?? false };
  }
  return goal === undefined ? null : toGoal(goal, kind, around, refuse);
}

function toPublish(
  { topic, type, message }: NonNullable<CommandValues['publish']>,
  kind: GraphOptions['kind'],
  around: Surroundings,
  refuse: Refuse,
): CommandAction | null {
  if (VELOCITIES.has(type)) refuse(`must not publish ${type}: no command moves the robot`);
  takeTopic(topic, type, around, refuse);
  const bytes = encoded(() => fixedMessage(kind === 'ros1' ? 1 : 2, type, message), 'message', refuse);
  return bytes === null ? null : { kind: 'publish', topic, type, bytes };
}

function toGoal(
  { action, type, definition, fields }: NonNullable<CommandValues['goal']>,
  kind: GraphOptions['kind'],
  around: Surroundings,
  refuse: Refuse,
): CommandAction | null {
  if (kind === 'ros1') {
    takeTopic(`${action}/goal`, `${type} ${definition}`, around, refuse);
    takeTopic(`${action}/cancel`, 'actionlib_msgs/msg/GoalID', around, refuse);
  } else {
    const { feedback, status } = actionServices(action, type);
    for (const name of [action, feedback.topic, status.topic])
      takeName(name, `${type} ${definition}`, around, refuse);
  }
  const definitions = encoded(
    () => (kind === 'ros1' ? goalDefinitions(type, definition).goal : ros2GoalDefinitions(type, definition)),
    'goal.definition',
    refuse,
  );
  if (definitions === null) return null;
  const velocity = definitions.find(({ name = '' }) => VELOCITIES.has(ros2TypeOf(name)));
  if (velocity !== undefined) refuse(`goal.definition: has ${velocity.name}: no command moves the robot`);
  const bytes = encoded(
    () => fixedMessage(kind === 'ros1' ? 1 : 2, actionTypes(type).goal, fields, definitions),
    'goal.fields',
    refuse,
  );
  return bytes === null ? null : { kind: 'goal', action, type, definition, bytes };
}

/** Services and actions of ROS 2 are not topics; one with the name of a topic that the robot uses is of the same program. */
function takeName(name: string, type: string, { used, types }: Surroundings, refuse: Refuse): void {
  const use = used.get(name);
  if (use !== undefined) refuse(`must not call ${name}: ${use}`);
  const key = `service ${name}`;
  if ((types.get(key) ?? type) !== type) refuse(`${name} has another type in a command before`);
  types.set(key, type);
}

/** No command touches what the robot uses otherwise, and each topic has one type. */
function takeTopic(topic: string, type: string, { used, types }: Surroundings, refuse: Refuse): void {
  const use = used.get(topic);
  if (use !== undefined) refuse(`must not publish on ${topic}: ${use}`);
  if ((types.get(topic) ?? type) !== type) refuse(`${topic} has another type in a command before`);
  types.set(topic, type);
}

function encoded<Value>(encode: () => Value, what: string, refuse: Refuse): Value | null {
  try {
    return encode();
  } catch (error) {
    if (!(error instanceof RosFault)) throw error;
    refuse(`${what}: ${error.message}`);
    return null;
  }
}

/** Topics that a command must not touch: those that move or stop the robot, and those that say where it is and what is there. */
function topicsInUse(values: RobotOptionValues): Map<string, string> {
  const used = new Map<string, string>();
  const add = (topic: string | null, use: string) => {
    if (topic !== null) used.set(topic, use);
  };
  for (const { topic, as } of values.topics)
    add(topic, as === 'velocity' ? 'the robot’s velocities are published there' : 'the robot reads it');
  add(values.stopTopic, 'it stops the robot');
  add(values.returnTopic, 'the robot announces its return there');
  add(values.guardCollisionTopic, 'it bounds the robot’s motion');
  for (const { topic } of values.guardScan) add(topic, 'it bounds the robot’s motion');
  return used;
}
