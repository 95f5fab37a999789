/** Only who has a grant gets in: an independent WebRTC client against the running robot and signaling service. */
import { writeFileSync } from 'node:fs';
import { issueGrant, makeOperatorKey } from '@farpoint/grants';
import { type GrantedOperator, grantTo, makeIssuer } from '@farpoint/grants/testing';
import type { Role } from '@farpoint/protocol';
import { eventually } from '@farpoint/service/testing/eventually';
import { beforeEach, describe, expect, it } from 'vitest';
import { metricOf } from './testing/metric-of.ts';
import { type ChangedFacts, shownGrant } from './testing/shown-grant.ts';
import type { Credentials, SignaledOperator } from './testing/signaled-operator.ts';
import { useGrantingRobot } from './testing/use-granting-robot.ts';

const ROBOT = 'sim-1';
const { robot, issuer, keyFile, trust, grant, connect, connectWith, openWith } = await useGrantingRobot(
  ROBOT,
  ['--max-operators', '16'],
);
const other = await makeIssuer('k2', 'ES256');

const nowS = () => Date.now() / 1000;

const shownBy = (grant: Pick<GrantedOperator, 'grant' | 'key'>, change?: ChangedFacts) =>
  shownGrant(ROBOT, grant, change);

const connectAs = async (role: Role, name: string) => connect(await grant(name, role));

type Client = SignaledOperator['client'];

/** The lease, as soon as the driver of an earlier test has gone. */
async function takeLease(client: Client): Promise<string> {
  await client.until(() => holder(client) === 'nobody');
  return client.takeLease();
}

function holder({ session }: Client): string | undefined {
  const lease = session.findLast(({ type }) => type === 'lease');
  return lease?.type === 'lease' ? lease.holder : undefined;
}

const refusals = (reason: string) =>
  metricOf(robot.stack.robotAdminUrl(ROBOT), `farpoint_robot_refused_total{what="grant",reason="${reason}"}`);

describe('who is admitted', { timeout: 30_000 }, () => {
  it('a driver is welcomed by its name, sees, drives and goes on over an ICE restart', async () => {
    const operator = await connectAs('drive', 'Ada');
    const { client } = operator;
    const { access } = await client.message('welcome');
    expect(access).toMatchObject({ role: 'drive', name: 'Ada' });
    expect(access?.expiresInS).toBeGreaterThan(3500);
    const lease = await takeLease(client);
    expect(client.session.findLast(({ type }) => type === 'lease')).toMatchObject({ driver: 'Ada' });
    const timer = setInterval(() => client.drive(lease, 0.1), 20);
    try {
      await client.until(() => client.telemetry?.drive === 'driving' && client.completeFrames.length > 0);
      await operator.resume();
      await operator.until(({ type }) => type === 'session.resuming');
      const { length } = client.completeFrames;
      await client.until(() => client.completeFrames.length > length + 5);
    } finally {
      clearInterval(timer);
    }
  });

  it('SIGHUP changes the keys: sessions of a key that has gone end, and those of a new one are admitted', async () => {
    const { pid = 0 } = robot.stack.robot(ROBOT);
    const kept = await connectAs('watch', 'Ada');
    const fresh = await grantTo(other, nowS(), { name: 'Grace' });
    try {
      writeFileSync(keyFile, '{"keys":');
      process.kill(pid, 'SIGHUP');
      await eventually(() => robot.stack.robot(ROBOT).output.includes('could not read the keys'));
      const { length } = kept.client.completeFrames;
      await kept.client.until(() => kept.client.completeFrames.length > length);
      trust(other);
      process.kill(pid, 'SIGHUP');
      await kept.until((message) => message.type === 'session.closed' && message.reason === 'not-granted');
      const { client } = await connect(fresh);
      expect((await client.message('welcome')).access?.name).toBe('Grace');
    } finally {
      trust(issuer, other);
      process.kill(pid, 'SIGHUP');
      await eventually(() => robot.stack.robot(ROBOT).output.includes('["k1","k2"]'));
    }
    expect(robot.stack.robot(ROBOT).pid).toBe(pid);
  });
});

describe('who is not', { timeout: 30_000 }, () => {
  let ada: GrantedOperator;
  beforeEach(async () => {
    ada = await grantTo(issuer, nowS());
  });
  const changed = async (change: Parameters<typeof grantTo>[2]) =>
    shownBy({ ...ada, grant: await issueGrant({ ...ada.claims, ...change }, issuer.signingKey) });
  const stranger = `${'11:'.repeat(31)}11`;

  /** What the robot compares with what it knows itself. All other refusals: packages/grants/src/admission.test.ts. */
  const cases: [name: string, reason: string, credentials: () => Credentials | Promise<Credentials>][] = [
    ['nothing', 'grant-missing', () => () => Promise.resolve({})],
    ['an expired grant', 'grant-expired', () => changed({ exp: Math.floor(nowS()) - 1 })],
    ['a grant for another robot', 'grant-other-robot', () => changed({ robots: ['sim-2', 'hall-*'] })],
    [
      'another’s grant, with a key of its own',
      'proof-wrong-key',
      async () => shownBy({ ...ada, key: await makeOperatorKey() }),
    ],
    [
      'a proof for another certificate of the operator',
      'proof-other-fingerprint',
      () => shownBy(ada, () => ({ answer: `a=fingerprint:sha-256 ${stranger}` })),
    ],
    [
      'a proof for another certificate of the robot',
      'proof-other-fingerprint',
      () => shownBy(ada, () => ({ offer: `a=fingerprint:sha-256 ${stranger}` })),
    ],
  ];

  it.each(cases)('%s: one refusal and no packet', async (_, reason, credentials) => {
    await expectRefusal(reason, await credentials());
  });

  it('a grant and proof that somebody overheard in another session', async () => {
    let overheard: Awaited<ReturnType<Credentials>> = {};
    const own = shownBy(ada);
    const honest = await connectWith(async (facts) => {
      overheard = await own(facts);
      return overheard;
    });
    await expectRefusal('proof-other-session', () => Promise.resolve(overheard));
    const { length } = honest.client.completeFrames;
    await honest.client.until(() => honest.client.completeFrames.length > length);
  });

  async function expectRefusal(reason: string, credentials: Credentials): Promise<void> {
    const before = await refusals(reason);
    const operator = await openWith(credentials);
    await operator.until(({ type }) => type === 'session.closed');
    const closed = operator.heard.filter(({ type }) => type === 'session.closed');
    expect(closed).toMatchObject([{ reason: 'not-granted' }]);
    const { detail = '' } = closed[0] as { detail?: string };
    expect(detail).not.toMatch(/kid|alg|signature|session handle|fingerprint/);
    expect(await refusals(reason)).toBe(before + 1);
    expect(operator.client.packets).toBe(0);
    expect(operator.client.session).toEqual([]);
    expect(operator.client.connection.connectionState).not.toBe('connected');
  }
});
