/** What the running robot knows of persons by their grants: their places, and who of them pressed STOP. */
import { eventually } from '@farpoint/service/testing/eventually';
import { afterEach, expect, it } from 'vitest';
import { metricOf } from './testing/metric-of.ts';
import type { SignaledOperator } from './testing/signaled-operator.ts';
import { useGrantingRobot } from './testing/use-granting-robot.ts';

const ROBOT = 'sim-1';

// Hooks run in reverse order: this one after the operators of the test have closed.
afterEach(async () => {
  const operators = () => metricOf(robot.robot.stack.robotAdminUrl(ROBOT), 'farpoint_robot_operators');
  await eventually(async () => (await operators()) === 0);
});
const robot = await useGrantingRobot(ROBOT, ['--estop-release', 'latcher']);

const closedFor = async (operator: SignaledOperator) => {
  await operator.until(({ type }) => type === 'session.closed');
  return operator.heard.find(({ type }) => type === 'session.closed');
};

it('one watcher’s grant takes two of four places; a supervisor takes a watcher’s', {
  timeout: 60_000,
}, async () => {
  const wim = await robot.grant('Wim', 'watch');
  const first = await robot.connect(wim);
  await robot.connect(wim);
  const third = await robot.open(wim);
  expect(await closedFor(third)).toMatchObject({
    ...{ reason: 'robot-full', maxOperators: 4, detail: expect.stringContaining('2 sessions') },
  });
  await robot.connect(await robot.grant('Ada', 'drive'));
  await robot.connect(await robot.grant('Bob', 'drive'));
  const dan = await robot.grant('Dan', 'watch');
  const late = await robot.open(dan);
  expect(await closedFor(late)).toMatchObject({ reason: 'robot-full', detail: 'all places are taken' });
  const supervisor = await robot.connect(await robot.grant('Sue', 'supervise'));
  expect(await closedFor(first)).toMatchObject({
    ...{ reason: 'robot-full', detail: 'somebody with a higher role needed the place' },
  });
  await supervisor.client.until(() => supervisor.client.completeFrames.length > 0);
});

/** A session of this person, with a grant of its own. */
const connectAs = async (name: string) => robot.connect(await robot.grant(name, 'drive'));

const faults = ({ client }: SignaledOperator) =>
  client.session.flatMap((message) => (message.type === 'fault' ? [message.reason] : []));

it('whoever reconnects is still the one who latched, and nobody else is', { timeout: 30_000 }, async () => {
  const [first, bob] = [await connectAs('Ada'), await connectAs('Bob')];
  await bob.client.takeLease();
  first.client.sendSession({ type: 'estop', latch: true });
  await bob.client.message('estop', ({ latched }) => latched);
  const present = (count: number) =>
    bob.client.message('operators', ({ operators }) => operators.length === count);
  await present(2);
  await first.close();
  await present(1);
  const again = await connectAs('Ada');
  await again.client.message('estop', ({ latched }) => latched);
  bob.client.releaseEstop();
  await bob.client.until(() => faults(bob).includes('not-latcher'));
  bob.client.sendSession({ type: 'leaseRelease' });
  await again.client.message('lease', ({ holder }) => holder === 'nobody');
  await again.client.takeLease();
  again.client.releaseEstop();
  await again.client.message('estop', ({ latched }) => !latched);
  expect(faults(again)).toEqual([]);
});
