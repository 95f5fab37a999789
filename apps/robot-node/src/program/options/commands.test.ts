import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { makeSigningKey } from '@farpoint/grants';
import { afterAll, describe, expect, test } from 'vitest';
import { robotOf } from './testing/robot-of.ts';

const folder = mkdtempSync(join(tmpdir(), 'farpoint-commands-'));
afterAll(() => rmSync(folder, { recursive: true, force: true }));
/** Whatever its keys: it is there. */
const KEYS = join(folder, 'keys.json');
const { publicJwk } = await makeSigningKey();
writeFileSync(KEYS, JSON.stringify({ keys: [publicJwk] }));

const robot = (argv: string[], file: object | null = null) =>
  robotOf(argv, file === null ? null : JSON.stringify({ robot: file })).commands;

const graph = (kind: 'ros1' | 'ros2', ...commands: object[]) => ({
  ...{ source: { kind }, sink: { kind }, stops: { topic: '/stop' } },
  topics: [
    { topic: '/points', as: 'cloud' },
    { topic: '/odom', as: 'pose' },
    { topic: '/cmd_vel', as: 'velocity' },
    { topic: '/wheels/goal', as: 'battery', type: 'sensor_msgs/BatteryState' },
    { topic: '/arm/_action/status', as: 'diagnostics' },
  ],
  commands,
});
const publish = (topic: string, type: string, message?: object) => ({
  ...{ id: 'a', label: 'A', publish: { topic, type, message } },
});
const lights = { id: 'lights-on', label: 'Lights on', publish: { topic: '/lights', type: 'std_msgs/Bool' } };
const trigger = { id: 'charge', label: 'Charge', call: { service: '/charge', type: 'std_srvs/Trigger' } };
const dock = {
  ...{ id: 'dock', label: 'Dock' },
  goal: { action: '/dock', type: 'robot_msgs/Dock', definition: 'uint8 station', fields: { station: 3 } },
};
const withGoal = (change: object) => ({ ...dock, goal: { ...dock.goal, ...change } });

describe('robot commands', () => {
  test('are none unless they are configured', () => {
    expect(robot([])).toBeUndefined();
    expect(robot([], graph('ros1'))).toBeUndefined();
  });

  test('publish a fixed message, call a service or send a goal, with defaults that deny', () => {
    const on = { ...lights, publish: { ...lights.publish, message: { data: true } } };
    const service = { ...trigger, group: 'Battery', confirm: true, timeoutS: 600, who: 'drive' };
    const commands = robot([], graph('ros1', on, service, dock));
    expect(commands).toMatchObject({ graph: { kind: 'ros1' } });
    expect(commands?.commands).toEqual([
      {
        ...{ id: 'lights-on', label: 'Lights on', group: undefined, confirm: false, who: 'driver' },
        ...{ standing: false, onStop: 'cancel', perSecond: 1, timeoutMs: 5000 },
        action: { kind: 'publish', topic: '/lights', type: 'std_msgs/msg/Bool', bytes: Uint8Array.of(1) },
      },
      expect.objectContaining({
        ...{ id: 'charge', group: 'Battery', confirm: true, timeoutMs: 600_000, who: 'drive' },
        action: { kind: 'call', service: '/charge', type: 'std_srvs/Trigger', data: false },
      }),
      expect.objectContaining({
        action: {
          ...{ kind: 'goal', action: '/dock', type: 'robot_msgs/Dock', definition: 'uint8 station' },
          bytes: Uint8Array.of(3),
        },
      }),
    ]);
    expect(robot([], graph('ros2', on, trigger, dock))?.commands.map(({ action }) => action)).toMatchObject([
      { kind: 'publish', bytes: Uint8Array.of(0, 1, 0, 0, 1) },
      { kind: 'call', service: '/charge', type: 'std_srvs/Trigger', data: false },
      { kind: 'goal', action: '/dock', bytes: Uint8Array.of(0, 1, 0, 0, 3) },
    ]);
  });

  test('are there to try out at the simulator', () => {
    const ids = (argv: string[], file?: object) => robot(argv, file ?? null)?.commands.map(({ id }) => id);
    expect(ids(['--sim-commands'])).toEqual(['lights', 'horn', 'self-test']);
    const own = { id: 'horn', label: 'Beep', sim: 'horn' };
    expect(ids(['--sim-commands'], { commands: [own] })).toEqual(['horn', 'lights', 'self-test']);
    expect(() => robot(['--source', 'pcd', '--path', 'x', '--sim-commands'])).toThrow(/needs the source sim/);
  });

  test('record only where the configuration names a folder, by who may, and mark instants in what is recorded', () => {
    const told = (argv: string[], file?: object) =>
      robot(argv, file ?? null)?.commands.map(({ id, who, onStop }) => `${id} ${who} ${onStop}`);
    expect(told(['--record', 'a.mcap'])).toEqual(['bookmark drive continue']);
    const all = (who: string) => [
      `record ${who} continue`,
      `record-stop ${who} continue`,
      'bookmark drive continue',
    ];
    const folder = ['--record-folder', '/data'];
    expect(told(folder)).toEqual(all('drive'));
    expect(told([...folder, '--grant-keys', KEYS])).toEqual(all('supervise'));
    expect(told([...folder, '--grant-keys', KEYS, '--record-by', 'drive'])).toEqual(all('drive'));
    expect(() => robot([...folder, '--record-by', 'supervise'])).toThrow(/supervise needs access.grantKeys/);
    const mark = { id: 'bookmark', label: 'Mark', who: 'watch', record: 'bookmark' };
    expect(told(['--record', 'a.mcap'], { commands: [mark] })).toEqual(['bookmark watch cancel']);
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
    [
      'a service beside rclnodejs',
      { ...graph('ros2', trigger), ros: { graph: 'rclnodejs' } },
      /charge: services and actions of ROS 2 are called over DDS/,
    ],
    [
      'a service of a topic in use',
      graph('ros2', { ...trigger, call: { service: '/stop', type: 'std_srvs/Trigger' } }),
      /must not call \/stop: it stops the robot/,
    ],
    [
      'an action of a topic in use',
      graph('ros2', withGoal({ action: '/cmd_vel' })),
      /must not call \/cmd_vel/,
    ],
    [
      'an action’s topic in use',
      graph('ros2', withGoal({ action: '/arm' })),
      /must not call \/arm\/_action\/status: the robot reads it/,
    ],
    [
      'two types of a service',
      graph('ros2', trigger, { ...trigger, id: 'b', call: { service: '/charge', type: 'std_srvs/Empty' } }),
      /\/charge has another type/,
    ],
    [
      'two types of an action',
      graph('ros2', dock, { ...withGoal({ type: 'robot_msgs/Land' }), id: 'b' }),
      /\/dock has another type/,
    ],
    ...(['ros1', 'ros2'] as const).map((kind): [string, object, RegExp] => [
      `a goal with velocities in ${kind}`,
      graph(kind, withGoal({ definition: 'geometry_msgs/Twist speed', fields: {} })),
      /goal.definition: has geometry_msgs\/Twist: no command moves the robot/,
    ]),
    [
      'a goal that is none in ROS 2',
      graph('ros2', withGoal({ fields: { station: 256 } })),
      /goal.fields: station must be a whole number from 0 to 255/,
    ],
    [
      'a goal’s topic in use',
      graph('ros1', withGoal({ action: '/wheels' })),
      /must not publish on \/wheels\/goal/,
    ],
    [
      'a goal that is none',
      graph('ros1', withGoal({ fields: { place: 1 } })),
      /goal.fields: place is no field/,
    ],
    [
      'a goal of unknown parts',
      graph('ros1', withGoal({ definition: 'a/B c' })),
      /goal.definition: a\/B is not/,
    ],
    [
      'another service',
      graph('ros1', { ...trigger, call: { service: '/x', type: 'nav/Go' } }),
      /must be std_srvs/,
    ],
    [
      'no data for SetBool',
      graph('ros1', { ...trigger, call: { service: '/x', type: 'std_srvs/SetBool' } }),
      /data/,
    ],
    ['no graph', { commands: [lights] }, /needs a ROS graph/],
    ['the simulator elsewhere', graph('ros1', { id: 'a', label: 'A', sim: 'horn' }), /needs the source sim/],
    [
      'supervisors where nobody is one',
      { commands: [{ id: 'a', label: 'A', sim: 'horn', who: 'supervise' }] },
      /grantKeys/,
    ],
    ['nothing to do', graph('ros1', { id: 'a', label: 'A' }), /one of publish, call, goal, record and sim/],
    ['two things to do', graph('ros1', { ...lights, call: trigger.call }), /one of publish, call, goal/],
    [
      'too many',
      graph('ros1', ...Array.from({ length: 33 }, (_, k) => ({ ...lights, id: `c${k}` }))),
      /at most 32 commands/,
    ],
    ['the same id twice', graph('ros1', lights, lights), /each id once/],
    ['an id that is none', graph('ros1', { ...lights, id: 'Lights On' }), /1–32 of a–z/],
    ['an unknown key', graph('ros1', { ...lights, lease: false }), /lease/],
    ['no rate', graph('ros1', { ...lights, perSecond: 0 }), /at least 0\.01/],
    ['too high a rate', graph('ros1', { ...lights, perSecond: 11 }), /at most 10/],
    ['too long a time', graph('ros1', { ...lights, timeoutS: 601 }), /at most 600/],
  ])('with %s are refused', (_, file, message) => {
    expect(() => robot([], file)).toThrow(message);
  });
});
