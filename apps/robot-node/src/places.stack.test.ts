/** Who gets a place of the running robot, with the real signaling service. */
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { type GrantedOperator, grantTo, makeIssuer } from '@farpoint/grants/testing';
import type { Role } from '@farpoint/protocol';
import { afterAll, expect, it } from 'vitest';
import { shownGrant } from './testing/shown-grant.ts';
import { SignaledOperator } from './testing/signaled-operator.ts';
import { useRobot } from './testing/use-robot.ts';

const ROBOT = 'sim-1';
const folder = mkdtempSync(join(tmpdir(), 'farpoint-places-'));
const keyFile = join(folder, 'grant-keys.json');
const issuer = await makeIssuer('k1');
writeFileSync(keyFile, JSON.stringify({ keys: [issuer.publicJwk] }));
afterAll(() => rmSync(folder, { recursive: true }));

const robot = useRobot(ROBOT, [
  ...['--rate-control', 'fixed', '--sim-size', '64', '--max-points', '600'],
  ...['--grant-keys', keyFile],
]);
const granted = (sub: string, role: Role) => grantTo(issuer, Date.now() / 1000, { role, name: sub, sub });
const options = (grant: GrantedOperator) => ({ credentials: shownGrant(ROBOT, grant) });
const connect = async (grant: GrantedOperator) =>
  robot.keep(await SignaledOperator.connect(robot.stack.signalingUrl, ROBOT, options(grant)));
const closedFor = async (operator: SignaledOperator) => {
  await operator.until(({ type }) => type === 'session.closed');
  return operator.heard.find(({ type }) => type === 'session.closed');
};

it('one watcher’s grant takes two of four places; a supervisor takes a watcher’s', {
  timeout: 60_000,
}, async () => {
  const wim = await granted('Wim', 'watch');
  const first = await connect(wim);
  await connect(wim);
  const third = robot.keep(await SignaledOperator.open(robot.stack.signalingUrl, ROBOT, options(wim)));
  expect(await closedFor(third)).toMatchObject({
    ...{ reason: 'robot-full', maxOperators: 4, detail: expect.stringContaining('2 sessions') },
  });
  await connect(await granted('Ada', 'drive'));
  await connect(await granted('Bob', 'drive'));
  const dan = await granted('Dan', 'watch');
  const late = robot.keep(await SignaledOperator.open(robot.stack.signalingUrl, ROBOT, options(dan)));
  expect(await closedFor(late)).toMatchObject({ reason: 'robot-full', detail: 'all places are taken' });
  const supervisor = await connect(await granted('Sue', 'supervise'));
  expect(await closedFor(first)).toMatchObject({
    ...{ reason: 'robot-full', detail: 'somebody with a higher role needed the place' },
  });
  await supervisor.client.until(() => supervisor.client.completeFrames.length > 0);
});
