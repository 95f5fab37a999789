import { resolveOptions } from '@farpoint/service';
import { describe, expect, test } from 'vitest';
import { toRobotOptions } from './robot-options.ts';
import { robotProgram } from './robot-program.ts';

function robot(argv: string[], robotText: object | null = null) {
  const text = robotText === null ? null : JSON.stringify({ robot: robotText });
  const resolved = resolveOptions(robotProgram, { argv, env: {}, readFile: () => text });
  if (resolved.action !== 'run') throw new Error('printed');
  return toRobotOptions(resolved.values, resolved.where).commands;
}

const graph = (kind: 'ros1' | 'ros2', ...commands: object[]) => ({
  ...{ source: { kind }, sink: { kind }, stops: { topic: '/stop' } },
  topics: [
    { topic: '/points', as: 'cloud' },
    { topic: '/odom', as: 'pose' },
    { topic: '/cmd_vel', as: 'velocity' },
  ],
  goals: { navigator: 'ros' },
  commands,
});
const publish = (topic: string, type: string, message?: object) => ({
  ...{ id: 'a', label: 'A', publish: { topic, type, message } },
});
const lights = { id: 'lights-on', label: 'Lights on', publish: { topic: '/lights', type: 'std_msgs/Bool' } };
const dock = { id: 'dock', label: 'Dock', call: { service: '/dock', type: 'std_srvs/Trigger' } };

describe('robot commands', () => {
  test('are none unless they are configured', () => {
    expect(robot([])).toBeUndefined();
    expect(robot([], graph('ros1'))).toBeUndefined();
  });

  test('publish a fixed message or call a service, with defaults that deny', () => {
    const on = { ...lights, publish: { ...lights.publish, message: { data: true } } };
    const commands = robot([], graph('ros1', on, { ...dock, group: 'Battery', confirm: true, timeoutS: 9 }));
    expect(commands).toMatchObject({ graph: { kind: 'ros1' } });
    expect(commands?.commands).toEqual([
      {
        ...{ id: 'lights-on', label: 'Lights on', group: undefined, confirm: false },
        ...{ holdsLease: true, whileStopped: true, perSecond: 1, timeoutMs: 5000 },
        action: { kind: 'publish', topic: '/lights', type: 'std_msgs/msg/Bool', bytes: Uint8Array.of(1) },
      },
      expect.objectContaining({
        ...{ id: 'dock', group: 'Battery', confirm: true, timeoutMs: 9000 },
        action: { kind: 'call', service: '/dock', type: 'std_srvs/Trigger', data: false },
      }),
    ]);
    expect(robot([], graph('ros2', on))?.commands[0]?.action).toMatchObject({
      bytes: Uint8Array.of(0, 1, 0, 0, 1),
    });
  });

  test('are there to try out at the simulator', () => {
    const ids = (argv: string[], text?: object) => robot(argv, text ?? null)?.commands.map(({ id }) => id);
    expect(ids(['--sim-commands'])).toEqual(['lights', 'horn', 'clear-faults']);
    const own = { id: 'horn', label: 'Beep', sim: 'horn' };
    expect(ids(['--sim-commands'], { commands: [own] })).toEqual(['horn', 'lights', 'clear-faults']);
  });

  test('record only where the robot’s configuration names a folder, and mark instants in what is recorded', () => {
    const actions = (argv: string[], text?: object) =>
      robot(argv, text ?? null)?.commands.map(({ id, action }) => [
        id,
        action.kind === 'record' && action.action,
      ]);
    expect(actions(['--record', 'a.mcap'])).toBeUndefined();
    expect(actions(['--record-folder', '/data'])).toEqual([
      ['record', 'start'],
      ['record-stop', 'stop'],
      ['bookmark', 'bookmark'],
    ]);
    const mark = { id: 'mark', label: 'Mark', holdsLease: false, record: 'bookmark' };
    expect(actions(['--record', 'a.mcap'], { commands: [mark] })).toEqual([['mark', 'bookmark']]);
    const record = { id: 'record', label: 'Rec', record: 'start' };
    expect(() => robot(['--record', 'a.mcap'], { commands: [record] })).toThrow(
      'record: record: start needs recording.folder',
    );
    expect(() => robot([], { commands: [mark] })).toThrow('needs recording.folder or recording.file');
  });

  test.each<[string, object, RegExp]>([
    [
      'the velocities’ topic',
      graph('ros1', publish('/cmd_vel', 'std_msgs/Bool')),
      /velocities are published/,
    ],
    ['velocities', graph('ros1', publish('/cmd_vel_2', 'geometry_msgs/Twist')), /no command moves the robot/],
    [
      'velocities with a time',
      graph('ros2', publish('/v', 'geometry_msgs/msg/TwistStamped')),
      /no command moves/,
    ],
    ['a topic that is read', graph('ros1', publish('/odom', 'std_msgs/Bool')), /the robot reads it/],
    ['the stop’s topic', graph('ros1', publish('/stop', 'std_msgs/Bool')), /it stops the robot/],
    ['the goals’ topic', graph('ros1', publish('/goal_pose', 'geometry_msgs/PoseStamped')), /to places/],
    [
      'the navigator’s topic',
      graph('ros1', publish('/cmd_vel_nav', 'std_msgs/Bool')),
      /navigator’s velocities/,
    ],
    ['an unknown type', graph('ros1', publish('/x', 'my_msgs/Thing')), /not one of ROS’s own types/],
    [
      'a wrong value',
      graph('ros1', publish('/x', 'std_msgs/Bool', { data: 1 })),
      /a: message: data must be true/,
    ],
    [
      'two types',
      graph('ros1', publish('/x', 'std_msgs/Bool'), { ...publish('/x', 'std_msgs/String'), id: 'b' }),
      /another type/,
    ],
    ['a service in ROS 2', graph('ros2', dock), /dock: services can be called in a ROS 1 graph only/],
    [
      'another service',
      graph('ros1', { ...dock, call: { service: '/x', type: 'nav/Go' } }),
      /must be std_srvs/,
    ],
    [
      'no data for SetBool',
      graph('ros1', { ...dock, call: { service: '/x', type: 'std_srvs/SetBool' } }),
      /data/,
    ],
    ['no graph', { commands: [lights] }, /needs a ROS graph/],
    ['the simulator elsewhere', graph('ros1', { id: 'a', label: 'A', sim: 'horn' }), /needs the source sim/],
    ['nothing to do', graph('ros1', { id: 'a', label: 'A' }), /one of publish, call, record and sim/],
    [
      'two things to do',
      graph('ros1', { ...lights, call: dock.call }),
      /one of publish, call, record and sim/,
    ],
    ['the same id twice', graph('ros1', lights, lights), /each id once/],
    ['an id that is none', graph('ros1', { ...lights, id: 'Lights On' }), /1–32 of a–z/],
    ['an unknown key', graph('ros1', { ...lights, lease: false }), /lease/],
    ['no rate', graph('ros1', { ...lights, perSecond: 0 }), /at least 0\.01/],
  ])('with %s are refused', (_, text, message) => {
    expect(() => robot([], text)).toThrow(message);
  });
});
