/** Robot commands at the real robot program in a ROS 1 graph: a topic hears one, an action server does one, and is stopped. */
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { LocalStack } from '@farpoint/local-stack';
import type { CommandRun, CommandState } from '@farpoint/protocol';
import { definitionsOf, type Publisher, type RosGraph } from '@farpoint/ros';
import { openRos1Graph } from '@farpoint/ros/ros1';
import { messageBytes } from '@farpoint/ros/testing';
import { SmallMaster } from '@farpoint/ros/testing/small-master';
import { eventually } from '@farpoint/service/testing/eventually';
import { useFolder } from '@farpoint/service/testing/folder';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { monotonicMs } from './ground/clock.ts';
import { SignaledOperator } from './testing/signaled-operator.ts';

const ROBOT = 'ros-1';
const folder = useFolder();
/** What the library needs of a result and of feedback that have no fields of their own. */
const statusOf = (name: string) => [
  {
    name,
    definitions: [
      { name: 'header', type: 'std_msgs/Header', isComplex: true },
      { name: 'status', type: 'actionlib_msgs/GoalStatus', isComplex: true },
    ],
  },
  ...(definitionsOf(1, 'std_msgs/Header') ?? []),
  ...(definitionsOf(1, 'actionlib_msgs/GoalStatus') ?? []),
];
const commands = [
  {
    id: 'lights',
    label: 'Lights',
    publish: { topic: '/lights', type: 'std_msgs/Bool', message: { data: true } },
  },
  { id: 'unheard', label: 'Unheard', publish: { topic: '/unheard', type: 'std_msgs/Empty' } },
  { id: 'absent', label: 'Absent', call: { service: '/absent', type: 'std_srvs/Trigger' } },
  {
    ...{ id: 'dock', label: 'Dock', timeoutS: 60, perSecond: 10 },
    goal: { action: '/dock', type: 'robot_msgs/Dock', definition: 'uint8 station', fields: { station: 3 } },
  },
].map((command) => ({ perSecond: 10, ...command }));

/** An action server that says nothing until it is told to. */
class DockServer {
  readonly goals: string[] = [];
  readonly cancelled: string[] = [];
  readonly #publishers: Record<'feedback' | 'result', Publisher>;

  constructor(graph: RosGraph) {
    const publish = (part: 'feedback' | 'result', name: string) =>
      graph.advertise({
        topic: `/dock/${part}`,
        type: `robot_msgs/msg/${name}`,
        definitions: statusOf(`robot_msgs/${name}`),
      });
    this.#publishers = {
      feedback: publish('feedback', 'DockActionFeedback'),
      result: publish('result', 'DockActionResult'),
    };
    const textAt = (bytes: Uint8Array, at: number) =>
      new TextDecoder().decode(bytes.subarray(at + 4, at + 4 + (bytes[at] ?? 0)));
    const subscribe = (part: string, type: string, take: (bytes: Uint8Array) => void) =>
      graph.subscribe({ topic: `/dock/${part}`, type, queue: 8 }, take);
    // A header without a frame, a time; its name, and the station.
    subscribe('goal', 'robot_msgs/msg/DockActionGoal', (bytes) => {
      this.goals.push(textAt(bytes, 24));
      expect(bytes.at(-1)).toBe(3);
    });
    subscribe('cancel', 'actionlib_msgs/msg/GoalID', (bytes) => this.cancelled.push(textAt(bytes, 8)));
  }

  say(part: 'feedback' | 'result', id: string, status: number, text: string): void {
    const header = messageBytes(1, 'std_msgs/msg/Header', {
      seq: 0,
      stamp: { sec: 1, nsec: 0 },
      frame_id: 'dock',
    });
    const goal = { goal_id: { stamp: { sec: 1, nsec: 0 }, id }, status, text };
    const rest = messageBytes(1, 'actionlib_msgs/msg/GoalStatus', goal);
    this.#publishers[part].publish(Uint8Array.of(...header, ...rest));
  }
}

describe('robot commands in a ROS 1 graph', { timeout: 60_000 }, () => {
  let master: SmallMaster;
  let graph: RosGraph;
  let server: DockServer;
  let stack: LocalStack;
  let driver: SignaledOperator;
  const lights: number[] = [];
  let request = 0;

  beforeAll(async () => {
    master = await SmallMaster.open();
    graph = await openRos1Graph({ masterUrl: master.url, name: 'base', hostname: '127.0.0.1' }, monotonicMs);
    graph.subscribe({ topic: '/lights', type: 'std_msgs/msg/Bool', queue: 8 }, ([data]) =>
      lights.push(data ?? -1),
    );
    // Without wheels, the robot is not ready.
    graph.subscribe({ topic: '/cmd_vel', type: 'geometry_msgs/msg/Twist', queue: 1 }, () => undefined);
    server = new DockServer(graph);
    const config = join(folder, 'farpoint.yaml');
    const robot = {
      sink: { kind: 'ros1' },
      ros: { master: master.url, hostname: '127.0.0.1' },
      topics: [{ topic: '/cmd_vel', as: 'velocity' }],
      commands,
    };
    // JSON is valid YAML.
    writeFileSync(config, JSON.stringify({ robot }));
    const args = ['--config', config, '--rate-control', 'fixed', '--sim-size', '64'];
    stack = await LocalStack.start({ robots: [{ id: ROBOT, name: 'Robot', args }] });
    driver = await SignaledOperator.connect(stack.signalingUrl, ROBOT);
    await driver.client.takeLease();
  }, 60_000);
  afterAll(async () => {
    await driver?.close();
    await stack?.stop();
    await graph?.close();
    master?.close();
  }, 30_000);

  const give = (id: string) => {
    driver.client.sendSession({ type: 'callCommand', id, request: ++request, timeMs: performance.now() });
    const own = request;
    return (state: CommandState): Promise<CommandRun> =>
      driver.client.message('commandRun', (each) => each.request === own && each.state === state);
  };
  /** Gives it until something there is connected. */
  const untilRunning = async (id: string): Promise<ReturnType<typeof give>> => {
    for (;;) {
      const run = give(id);
      const first = await Promise.race([
        run('done'),
        run('failed'),
        eventually(() => server.goals.length > 0),
      ]);
      if (first === true || first.state === 'done') return run;
    }
  };

  it('publishes just the message that is configured, and says where nothing hears it', async () => {
    await untilRunning('lights');
    await eventually(() => lights.length > 0);
    expect(new Set(lights)).toEqual(new Set([1]));
    expect(await give('unheard')('failed')).toMatchObject({ detail: 'nothing subscribes to /unheard' });
    expect(await give('absent')('failed')).toMatchObject({ detail: expect.stringContaining('no provider') });
  });

  it('sends a goal, tells how it goes, and how it ends', async () => {
    const run = await untilRunning('dock');
    const [id = ''] = server.goals;
    expect(id).toContain('farpoint_ros_1');
    server.say('feedback', 'of another node', 1, 'nothing');
    server.say('feedback', id, 1, 'turning');
    const told = await driver.client.message('commandRun', (each) => each.detail === 'turning');
    expect(told).toMatchObject({ id: 'dock', state: 'running' });
    server.say('result', id, 3, 'docked');
    expect(await run('done')).toMatchObject({ detail: 'docked', run: told.run });
  });

  it('cancels the goal when somebody asks, and when STOP is pressed', async () => {
    const first = give('dock');
    const { run } = await first('running');
    await eventually(() => server.goals.length === 2);
    driver.client.sendSession({ type: 'cancelCommand', run });
    await eventually(() => server.cancelled.length === 1);
    expect(server.cancelled).toEqual([server.goals[1]]);
    server.say('result', server.goals[1] ?? '', 2, '');
    expect(await first('cancelled')).toMatchObject({ run });
    const second = give('dock');
    await eventually(() => server.goals.length === 3);
    driver.client.sendSession({ type: 'estop', latch: true });
    await eventually(() => server.cancelled.length === 2);
    expect(server.cancelled[1]).toBe(server.goals[2]);
    // It does not answer.
    expect(await second('cancelled')).toMatchObject({ detail: 'by STOP; nothing has confirmed it' });
    const own = ++request;
    driver.client.sendSession({ type: 'callCommand', id: 'dock', request: own, timeMs: performance.now() });
    expect(await driver.client.message('commandRefused', (each) => each.request === own)).toMatchObject({
      reason: 'estop',
    });
  });
});
