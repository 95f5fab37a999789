import { MAX_ROBOT_COMMANDS } from '@farpoint/protocol';
import { fixedMessage, RosFault } from '@farpoint/ros';
import type {
  CommandAction,
  CommandOptions,
  CommandsConfiguration,
} from '../robot-commands/command-configuration.ts';
import type { GraphOptions } from '../ros/open-graph.ts';
import type { CommandValues } from './commands.ts';
import type { RobotOptionKey, RobotOptionValues } from './robot-program.ts';
import { rosKindOf } from './ros-kind.ts';

type Refuse = (detail: string) => void;

const SIM_COMMANDS: readonly CommandOptions[] = (
  [
    ['lights', 'Lights', 'Signals', {}],
    ['horn', 'Horn', 'Signals', { holdsLease: false }],
    ['clear-faults', 'Clear faults', 'Service', { confirm: true, whileStopped: true }],
  ] as const
).map(([action, label, group, change]) => ({
  ...{ id: action, label, group, confirm: false, holdsLease: true, whileStopped: false },
  ...{ perSecond: 1, timeoutMs: 5000, action: { kind: 'sim', action } },
  ...change,
}));

const RECORD_COMMANDS: readonly CommandOptions[] = (
  [
    ['record', 'Record', 'start', 1],
    ['record-stop', 'Stop recording', 'stop', 1],
    ['bookmark', 'Bookmark', 'bookmark', 5],
  ] as const
).map(([id, label, action, perSecond]) => ({
  ...{ id, label, group: 'Recording', confirm: false, holdsLease: true, whileStopped: true },
  ...{ perSecond, timeoutMs: 5000, action: { kind: 'record', action } },
}));

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
  const { commands, simCommands, recordFolder, source } = values;
  if (simCommands && source !== 'sim') refuse('simCommands', 'needs the source sim');
  const kind = rosKindOf(values);
  const used = topicsInUse(values);
  const types = new Map<string, string>();
  const configured = commands.flatMap((command): CommandOptions[] => {
    const { id, label, group, confirm, holdsLease, whileStopped, perSecond, timeoutS } = command;
    const isSim = source === 'sim';
    const records = { robot: values.record !== null, operators: recordFolder !== null };
    const action = toAction(command, { kind, isSim, records, used, types }, (detail) =>
      refuse('commands', `${id}: ${detail}`),
    );
    if (action === null) return [];
    const rules = { confirm, holdsLease, whileStopped, perSecond, timeoutMs: timeoutS * 1000 };
    return [{ id, label, group, ...rules, action }];
  });
  const own = new Set(configured.map(({ id }) => id));
  const others = [...(recordFolder === null ? [] : RECORD_COMMANDS), ...(simCommands ? SIM_COMMANDS : [])];
  const all = [...configured, ...others.filter(({ id }) => !own.has(id))].slice(0, MAX_ROBOT_COMMANDS);
  if (all.length === 0) return undefined;
  const needsGraph = all.some(({ action: { kind } }) => kind === 'publish' || kind === 'call');
  return { commands: all, graph: needsGraph && kind !== null ? graph(kind) : null };
}

interface Surroundings {
  kind: GraphOptions['kind'] | null;
  isSim: boolean;
  /** Whether the robot itself records, and whether operators may. */
  records: { robot: boolean; operators: boolean };
  /** What each topic is used for already. */
  used: ReadonlyMap<string, string>;
  /** Of the topics of the commands before. */
  types: Map<string, string>;
}

function toAction(
  { publish, call, sim, record }: CommandValues,
  { kind, isSim, records, used, types }: Surroundings,
  refuse: Refuse,
): CommandAction | null {
  if (sim !== undefined) {
    if (!isSim) refuse('sim needs the source sim');
    return { kind: 'sim', action: sim };
  }
  if (record !== undefined) {
    if (!records.operators && !(records.robot && record === 'bookmark'))
      refuse(`record: ${record} needs recording.folder${record === 'bookmark' ? ' or recording.file' : ''}`);
    return { kind: 'record', action: record };
  }
  if (kind === null) {
    refuse('needs a ROS graph: neither source nor sink is ROS');
    return null;
  }
  if (call !== undefined) {
    if (kind === 'ros2') refuse('services can be called in a ROS 1 graph only; publish on a topic instead');
    return { kind: 'call', service: call.service, type: call.type, data: call.data ?? false };
  }
  if (publish === undefined) return null;
  const { topic, type, message } = publish;
  const use = used.get(topic);
  if (use !== undefined) refuse(`must not publish on ${topic}: ${use}`);
  if (VELOCITIES.has(type)) refuse(`must not publish ${type}: no command moves the robot`);
  if ((types.get(topic) ?? type) !== type) refuse(`${topic} has another type in a command before`);
  types.set(topic, type);
  try {
    return { kind: 'publish', topic, type, bytes: fixedMessage(kind === 'ros1' ? 1 : 2, type, message) };
  } catch (error) {
    if (!(error instanceof RosFault)) throw error;
    refuse(error.code === 'unsupported' ? error.message : `message: ${error.message}`);
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
  if (values.goals === 'ros') {
    add(values.goalsTopic, 'it sends the robot to places');
    add(values.goalsVelocityTopic, 'the navigator’s velocities are read there');
  }
  return used;
}
