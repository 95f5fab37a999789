/** The policy `latcher` with grants: who pressed STOP is the person, not the session. */
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { grantTo, makeIssuer } from '@farpoint/grants/testing';
import { afterAll, expect, it } from 'vitest';
import { shownGrant } from './testing/shown-grant.ts';
import { SignaledOperator } from './testing/signaled-operator.ts';
import { useRobot } from './testing/use-robot.ts';

const ROBOT = 'latcher-1';
const folder = mkdtempSync(join(tmpdir(), 'farpoint-latcher-'));
const keyFile = join(folder, 'grant-keys.json');
const issuer = await makeIssuer('k1');
writeFileSync(keyFile, JSON.stringify({ keys: [issuer.publicJwk] }));
afterAll(() => rmSync(folder, { recursive: true }));

const robot = useRobot(ROBOT, [
  ...['--rate-control', 'fixed', '--sim-size', '64', '--max-points', '600'],
  ...['--grant-keys', keyFile, '--estop-release', 'latcher'],
]);

let grants = 0;
/** A session of this person, with a grant of its own. */
async function connectAs(name: string): Promise<SignaledOperator> {
  const grant = await grantTo(issuer, Date.now() / 1000, {
    ...{ name, sub: name, role: 'drive', jti: `g${++grants}` },
  });
  const credentials = shownGrant(ROBOT, grant);
  return robot.keep(await SignaledOperator.connect(robot.stack.signalingUrl, ROBOT, { credentials }));
}

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
