/** Robot commands at the real robot program in a ROS 1 graph: a topic hears one, services do, refuse, break and hang. */
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { LocalStack } from '@farpoint/local-stack';
import type { CommandAnswer } from '@farpoint/protocol';
import { type Ros1Node, Ros1Peers } from '@farpoint/ros/testing/ros1';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { metricOf } from './testing/metric-of.ts';
import { SignaledOperator } from './testing/signaled-operator.ts';

const ROBOT = 'ros-1';
const { python, missing } = Ros1Peers.find();

const trigger = (id: string, change: object = {}) => ({
  ...{ id, label: id, perSecond: 10, call: { service: `/${id}`, type: 'std_srvs/Trigger' }, ...change },
});
const lights = (id: string, data: boolean) => ({
  ...{ id, label: id, perSecond: 10 },
  publish: { topic: '/lights', type: 'std_msgs/Bool', message: { data } },
});
const commands = [
  { ...lights('lights-on', true), label: 'Lights on', group: 'Lights' },
  lights('lights-off', false),
  trigger('dock', { confirm: true }),
  trigger('charge'),
  trigger('breaks'),
  trigger('hangs', { timeoutS: 0.5 }),
  trigger('absent'),
  {
    ...{ id: 'horn', label: 'Horn', holdsLease: false, whileStopped: false },
    call: { service: '/horn', type: 'std_srvs/SetBool', data: true },
  },
  {
    ...{ id: 'unheard', label: 'Unheard' },
    publish: { topic: '/unheard', type: 'std_msgs/String', message: { data: 'x' } },
  },
];

describe.skipIf(python === null)(
  `robot commands in a ROS 1 graph (${missing ?? 'rosmaster, rospy'})`,
  { timeout: 60_000 },
  () => {
    const folder = mkdtempSync(join(tmpdir(), 'farpoint-commands-'));
    const auditLog = join(folder, 'audit.jsonl');
    let peers: Ros1Peers;
    let node: Ros1Node;
    let stack: LocalStack;
    let driver: SignaledOperator;
    let guest: SignaledOperator;
    let request = 0;

    beforeAll(async () => {
      peers = await Ros1Peers.open(python ?? '');
      await peers.startCore();
      node = await peers.startNode('cloud,commands', 'base');
      const config = join(folder, 'farpoint.yaml');
      const robot = {
        ...{ source: { kind: 'ros1' }, ros: { master: peers.masterUrl, hostname: '127.0.0.1' } },
        topics: [
          { topic: '/points', as: 'cloud' },
          { topic: '/camera_info', as: 'cameraInfo' },
        ],
        commands,
      };
      // JSON is valid YAML.
      writeFileSync(config, JSON.stringify({ robot }));
      const args = ['--config', config, '--audit-log', auditLog];
      stack = await LocalStack.start({ robots: [{ id: ROBOT, name: 'Robot', args }] });
      driver = await SignaledOperator.connect(stack.signalingUrl, ROBOT);
      guest = await SignaledOperator.connect(stack.signalingUrl, ROBOT);
      await driver.client.takeLease();
    }, 60_000);

    afterAll(async () => {
      await driver?.close();
      await guest?.close();
      await stack?.stop();
      await peers?.close();
      rmSync(folder, { recursive: true, force: true });
    }, 30_000);

    const give = async ({ client }: SignaledOperator, id: string): Promise<CommandAnswer> => {
      const own = ++request;
      client.sendSession({ type: 'callCommand', id, request: own, timeMs: performance.now() });
      return client.message('commandAnswer', (each) => each.request === own);
    };
    const heard = (topic: string) => node.heard.filter((each) => each.topic === topic).map(({ x }) => x);
    const until = async (is: () => boolean) => {
      while (!is()) await new Promise((resolve) => setTimeout(resolve, 5));
    };
    /** Of each command, what was told last. */
    const told = ({ client }: SignaledOperator) =>
      new Map(client.session.filter((each) => each.type === 'robotCommand').map((each) => [each.id, each]));

    it('tells them in order, and who may give them', async () => {
      await driver.client.until(() => told(driver).get('lights-on')?.barred === undefined);
      await guest.client.until(() => told(guest).size === commands.length);
      expect([...told(guest).keys()]).toEqual(commands.map(({ id }) => id));
      expect(told(guest).get('lights-on')).toEqual({
        ...{
          type: 'robotCommand',
          id: 'lights-on',
          label: 'Lights on',
          group: 'Lights',
          barred: 'not-driver',
        },
      });
      expect(told(driver).get('dock')).toMatchObject({ confirm: true });
      expect(told(guest).get('horn')).not.toHaveProperty('barred');
    });

    it('publishes just the message that is configured, for who drives', async () => {
      // The subscriber may still be connecting.
      while ((await give(driver, 'lights-on')).outcome !== 'done')
        await new Promise((resolve) => setTimeout(resolve, 250));
      expect(await give(driver, 'lights-off')).toMatchObject({ outcome: 'done' });
      await until(() => heard('/lights').length === 2);
      expect(await give(guest, 'lights-on')).toMatchObject({ outcome: 'refused', reason: 'not-driver' });
      expect(await give(driver, 'unheard')).toMatchObject({
        ...{ outcome: 'failed', detail: 'nothing subscribes to /unheard' },
      });
      expect(heard('/lights')).toEqual([1, 0]);
    });

    it('calls services, and tells what they answer, or that they do not', async () => {
      expect(await give(driver, 'dock')).toMatchObject({ outcome: 'done', detail: 'docked' });
      expect(await give(driver, 'charge')).toMatchObject({ outcome: 'failed', detail: 'no charger' });
      expect(await give(driver, 'breaks')).toMatchObject({
        ...{ outcome: 'failed', detail: expect.stringContaining('out of order') },
      });
      expect(await give(driver, 'absent')).toMatchObject({
        ...{ outcome: 'failed', detail: expect.stringContaining('/absent') },
      });
      const hangs = give(driver, 'hangs');
      expect(await give(driver, 'hangs')).toMatchObject({ outcome: 'refused', reason: 'busy' });
      expect(await hangs).toMatchObject({ outcome: 'timed-out' });
    });

    it('lets others give what needs no lease, not too often, and not while STOP is on', async () => {
      expect(await give(guest, 'horn')).toMatchObject({ outcome: 'done' });
      // Its node says so in a line of its own.
      await until(() => heard('/horn').length > 0);
      expect(await give(guest, 'horn')).toMatchObject({ outcome: 'refused', reason: 'too-often' });
      guest.client.sendSession({ type: 'estop', latch: true });
      await guest.client.until(() => told(guest).get('horn')?.barred === 'estop');
      expect(await give(guest, 'horn')).toMatchObject({ outcome: 'refused', reason: 'estop' });
      expect(await give(driver, 'dock')).toMatchObject({ outcome: 'done' });
    });

    it('refuses what is not configured or comes too late, and has written everything down', async () => {
      expect(await give(driver, 'lights')).toMatchObject({ outcome: 'refused', reason: 'unknown' });
      driver.client.sendSession({ type: 'callCommand', id: 'dock', request: 999, timeMs: 0 });
      expect(await driver.client.message('commandAnswer', (each) => each.request === 999)).toMatchObject({
        ...{ outcome: 'refused', reason: 'stale' },
      });
      const metric = (name: string) => metricOf(stack.robotAdminUrl(ROBOT), `farpoint_robot_${name}`);
      expect(await metric('command_calls_total{command="dock"}')).toBe(2);
      expect(await metric('command_outcomes_total{outcome="timed-out"}')).toBe(1);
      expect(await metric('command_outcomes_total{outcome="unknown"}')).toBe(1);
      const entries = readFileSync(auditLog, 'utf8')
        .trim()
        .split('\n')
        .map((line) => JSON.parse(line) as { kind: string; details: object })
        .filter(({ kind }) => kind === 'robot-command');
      expect(entries.map(({ details }) => details)).toContainEqual({
        ...{ id: 'hangs', outcome: 'timed-out' },
      });
      expect(entries.map(({ details }) => details)).toContainEqual({
        ...{ id: 'lights', outcome: 'refused', reason: 'unknown' },
      });
    });
  },
);
