/**
 * Robot commands at the real robot program in a ROS 2 graph: a service and an action server that stand in for a node on
 * rmw_cyclonedds, on another encoder.
 */
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { DdsGraph, isAvailable } from '@farpoint/dds';
import { findServicePeer, ServicePeer, type ServicePeerCommand, testDomain } from '@farpoint/dds/testing';
import { LocalStack } from '@farpoint/local-stack';
import type { CommandRun, CommandState } from '@farpoint/protocol';
import { eventually } from '@farpoint/service/testing/eventually';
import { useFolder } from '@farpoint/service/testing/folder';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { SignaledOperator } from './testing/signaled-operator.ts';

const ROBOT = 'ros2-servers';
const SEND = '/dock/_action/send_goal';
const CANCEL = '/dock/_action/cancel_goal';
const RESULT = '/dock/_action/get_result';
const folder = useFolder();
const command = isAvailable() ? findServicePeer() : null;
const goal = {
  ...{ action: '/dock', type: 'robot_msgs/Dock', definition: 'uint8 station\nfloat64 distance' },
  fields: { station: 3, distance: 0.5 },
};
const commands = [
  { id: 'charge', label: 'Charge', call: { service: '/charge', type: 'std_srvs/Trigger' } },
  { id: 'absent', label: 'Absent', call: { service: '/absent', type: 'std_srvs/Empty' } },
  { id: 'dock', label: 'Dock', goal },
].map((each) => ({ perSecond: 10, timeoutS: 60, ...each }));

describe('robot commands in a ROS 2 graph with servers (needs CycloneDDS, the addon and pip install cyclonedds)', {
  skip: command === null,
  timeout: 60_000,
}, () => {
  let graph: DdsGraph;
  let peer: ServicePeer;
  let stack: LocalStack;
  let driver: SignaledOperator;
  let request = 0;

  beforeAll(async () => {
    const domain = testDomain();
    graph = new DdsGraph({ domain, localhostOnly: true });
    // Without wheels, the robot is not ready.
    graph.subscribe({ topic: '/cmd_vel', type: 'geometry_msgs/msg/Twist', queue: 1 }, () => undefined);
    peer = await ServicePeer.start(command as string[], { domain, service: '/charge', action: '/dock' });
    const config = join(folder, 'farpoint.yaml');
    const robot = {
      sink: { kind: 'ros2' },
      ros: { domain, reach: 'localhost', graph: 'dds' },
      topics: [{ topic: '/cmd_vel', as: 'velocity' }],
      commands,
    };
    writeFileSync(config, JSON.stringify({ robot }));
    const args = ['--config', config, '--rate-control', 'fixed', '--sim-size', '64'];
    stack = await LocalStack.start({ robots: [{ id: ROBOT, name: 'Robot', args }] });
    driver = await SignaledOperator.connect(stack.signalingUrl, ROBOT);
    await driver.client.takeLease();
  }, 60_000);
  afterAll(async () => {
    await driver?.close();
    await stack?.stop();
    await peer?.kill();
    await graph?.close();
  }, 30_000);

  const countOf = (service: string) => peer.requests.filter((each) => each.service === service).length;
  const give = (id: string) => {
    const own = ++request;
    driver.client.sendSession({ type: 'callCommand', id, request: own, timeMs: performance.now() });
    return (state: CommandState): Promise<CommandRun> =>
      driver.client.message('commandRun', (each) => each.request === own && each.state === state);
  };
  /** Gives it until its server has been found, and hears it. */
  const giveHeard = async (id: string, service: string) => {
    const count = countOf(service) + 1;
    const run = await eventually(async () => {
      const each = give(id);
      const first = await Promise.race([peer.request(service, count), each('failed')]);
      return 'service' in first ? each : null;
    });
    return { run, heard: await peer.request(service, count) };
  };
  const reply = (to: number, fields: Record<string, unknown>) => peer.do({ do: 'reply', to, fields });
  /** A goal that the server has accepted, and whose result it was asked for. */
  const dock = async () => {
    const count = countOf(RESULT) + 1;
    const { run, heard } = await giveHeard('dock', SEND);
    const { fields } = heard as unknown as { fields: { goal_id: { uuid: number[] } } };
    reply(heard.number, { accepted: true });
    const result = await peer.request(RESULT, count);
    expect(result.fields).toEqual({ goal_id: fields.goal_id });
    return {
      run,
      id: fields.goal_id.uuid,
      end: (status: number) => reply(result.number, { status, charge: 1 }),
    };
  };
  const tell = (what: ServicePeerCommand) => peer.do(what);

  it('calls a service, tells what it answers, and says where there is none', async () => {
    const { run, heard } = await giveHeard('charge', '/charge');
    reply(heard.number, { success: true, message: 'charging' });
    expect(await run('done')).toMatchObject({ detail: 'charging' });
    const second = await giveHeard('charge', '/charge');
    reply(second.heard.number, { success: false, message: 'no power' });
    expect(await second.run('failed')).toMatchObject({ detail: 'no power' });
    expect(await give('absent')('failed')).toMatchObject({ detail: '/absent: there is no such service' });
  });

  it('sends a goal, tells how it goes, and how it ends', async () => {
    const { heard } = await giveHeard('dock', SEND);
    expect(heard.fields).toMatchObject({ station: 3, distance: 0.5 });
    reply(heard.number, { accepted: false });
    const detail = 'the action server /dock refuses the goal';
    await driver.client.message('commandRun', (each) => each.state === 'failed' && each.detail === detail);
    const { run, id, end } = await dock();
    tell({ do: 'feedback', goal: id.map((byte) => byte ^ 1), left: 2 });
    tell({ do: 'status', goal: id, status: 2 });
    const told = await driver.client.message('commandRun', (each) => each.detail === 'running');
    end(4);
    expect(await run('done')).toMatchObject({ run: told.run });
    const aborted = await dock();
    aborted.end(6);
    await aborted.run('failed');
  });

  it('cancels the goal when somebody asks, and when STOP is pressed', async () => {
    const first = await dock();
    const { run } = await first.run('running');
    driver.client.sendSession({ type: 'cancelCommand', run });
    const asked = await peer.request(CANCEL);
    expect(asked.fields).toMatchObject({ goal_info: { goal_id: { uuid: first.id }, stamp: { sec: 0 } } });
    reply(asked.number, { return_code: 0, goals_canceling: [first.id] });
    tell({ do: 'status', goal: first.id, status: 3 });
    first.end(5);
    expect(await first.run('cancelled')).toMatchObject({ run });
    const second = await dock();
    driver.client.sendSession({ type: 'estop', latch: true });
    const stopped = await peer.request(CANCEL, 2);
    expect(stopped.fields).toMatchObject({ goal_info: { goal_id: { uuid: second.id } } });
    // It does not answer.
    expect(await second.run('cancelled')).toMatchObject({ detail: 'by STOP; nothing has confirmed it' });
  });

  it('cancels what runs when the robot ends', async () => {
    driver.client.sendSession({ type: 'estop', latch: false });
    await driver.client.takeLease();
    const { id } = await dock();
    await driver.close();
    await stack.stop();
    expect((await peer.request(CANCEL, 3)).fields).toMatchObject({ goal_info: { goal_id: { uuid: id } } });
  });
});
