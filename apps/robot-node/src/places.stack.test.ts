/** Who gets a place of the running robot, with the real signaling service. */
import { expect, it } from 'vitest';
import type { SignaledOperator } from './testing/signaled-operator.ts';
import { useGrantingRobot } from './testing/use-granting-robot.ts';

const robot = await useGrantingRobot('sim-1');
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
