/** The policy `latcher` with grants: who pressed STOP is the person, not the session. */
import { expect, it } from 'vitest';
import type { SignaledOperator } from './testing/signaled-operator.ts';
import { useGrantingRobot } from './testing/use-granting-robot.ts';

const robot = await useGrantingRobot('latcher-1', ['--estop-release', 'latcher']);

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
