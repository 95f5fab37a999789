/** Three people at the running robot: who pressed STOP, and how the drive goes from one to another. */
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import type { FaultReason, HandoverEnd, Role } from '@farpoint/protocol';
import { afterEach, describe, expect, it } from 'vitest';
import { metricOf } from './testing/metric-of.ts';
import type { SignaledOperator } from './testing/signaled-operator.ts';
import { steadyHand } from './testing/steady-hand.ts';
import { useGrantingRobot } from './testing/use-granting-robot.ts';

const ID = 'sim-1';
let auditLog = '';
const robot = await useGrantingRobot(ID, (folder) => {
  auditLog = join(folder, 'audit.jsonl');
  return [
    // Hands on a busy machine have pauses.
    ...['--watchdog-ms', '800', '--view-slow-ms', '1000', '--view-brake-ms', '2500'],
    ...['--audit-log', auditLog],
  ];
});
const hands: (() => void)[] = [];
afterEach(() => {
  for (const stop of hands.splice(0)) stop();
});

type Client = SignaledOperator['client'];
const FORWARD = { linear: { x: 0.3, y: 0, z: 0 }, angular: { x: 0, y: 0, z: 0.5 } };

const enter = async (name: string, role: Role): Promise<Client> =>
  (await robot.connect(await robot.grant(name, role))).client;

/** The operator's number in the list of this one. */
async function numberOf(client: Client, name: string): Promise<number> {
  const list = await client.message('operators', ({ operators }) =>
    operators.some((each) => each.name === name),
  );
  return list.operators.find((each) => each.name === name)?.number ?? Number.NaN;
}

const drives = (client: Client) => client.until(() => Math.abs(client.telemetry?.twist.linear.x ?? 0) > 0.1);
const ended = (client: Client, end: HandoverEnd) => client.message('handover', (each) => each.ended === end);
const fault = (client: Client, reason: FaultReason) =>
  client.message('fault', (each) => each.reason === reason);
/** What the operator heard last of the lease. */
const lastLease = ({ session }: Client) => session.findLast(({ type }) => type === 'lease');

/** The robot stands, and goes on standing for a second although hands hold on. */
async function expectStanding(client: Client): Promise<void> {
  const speed = () =>
    Math.abs(client.telemetry?.twist.linear.x ?? 1) + Math.abs(client.telemetry?.twist.angular.z ?? 1);
  await client.until(() => speed() === 0);
  const { sequence } = client.telemetry ?? { sequence: 0 };
  let fastest = 0;
  await client.until(() => {
    fastest = Math.max(fastest, speed());
    return (client.telemetry?.sequence ?? 0) >= sequence + 20;
  });
  expect(fastest).toBe(0);
}

/** Resolves after the robot has sent its state so often again. */
async function states(client: Client, count: number): Promise<void> {
  const { sequence } = client.telemetry ?? { sequence: 0 };
  await client.until(() => (client.telemetry?.sequence ?? 0) >= sequence + count);
}

describe('three people at one robot', { timeout: 60_000 }, () => {
  it('hand the drive over by an offer; nothing moves without a grip that was opened', async () => {
    const [ada, bob, wim] = [
      await enter('Ada', 'drive'),
      await enter('Bob', 'drive'),
      await enter('Wim', 'watch'),
    ];
    hands.push(steadyHand(ada, await ada.takeLease(), FORWARD));
    await drives(ada);

    ada.sendSession({ type: 'driveOffer', to: await numberOf(ada, 'Wim') });
    await fault(ada, 'only-watches');
    wim.sendSession({ type: 'driveAsk' });
    await fault(wim, 'not-permitted');
    ada.sendSession({ type: 'driveOffer', to: await numberOf(ada, 'Bob') });
    const offer = await bob.message('handover');
    expect(offer).toMatchObject({ kind: 'offer', from: { name: 'Ada' }, to: { name: 'Bob' }, yours: false });
    expect(offer.from).not.toHaveProperty('claimed');
    // It is Bob's to answer, and Ada still drives.
    for (const other of [ada, wim]) other.sendSession({ type: 'driveAnswer', id: offer.id, accept: true });
    await fault(wim, 'not-open');
    expect(lastLease(ada)).toMatchObject({ holder: 'you' });

    bob.sendSession({ type: 'driveAnswer', id: offer.id, accept: true });
    const { lease = '' } = await bob.message('lease', ({ holder }) => holder === 'you');
    // His hand is on the stick already, and hers still is.
    const holdsOn = steadyHand(bob, lease, FORWARD);
    hands.push(holdsOn);
    for (const each of [ada, bob]) await ended(each, 'accepted');
    await bob.message('rejected', ({ reason }) => reason === 'let-go-first');
    await ada.message('rejected', ({ reason }) => reason === 'not-lease-holder');
    await expectStanding(bob);
    expect(wim.session.some(({ type }) => type === 'handover')).toBe(false);
    holdsOn();
    // As a page does: one of them may be lost.
    for (let n = 1; n <= 10; n++) {
      bob.drive(lease, 0, { deadMan: false });
      await states(bob, 1);
    }
    expect(bob.telemetry?.motion?.letGoFirst).toBeUndefined();
    hands.push(steadyHand(bob, lease, FORWARD));
    await drives(bob);
    await wim.message('operators', ({ operators }) =>
      operators.some((each) => each.name === 'Bob' && each.drives),
    );
    const entries = readFileSync(auditLog, 'utf8')
      .split('\n')
      .filter((line) => line.includes('"lease-handed-over"'));
    expect(entries).toHaveLength(1);
    for (const name of ['"Ada"', '"Bob"']) expect(entries[0]).toContain(name);
  });

  it('see where one of them points, and who only watches does not point', async () => {
    const [ada, bob, wim] = [
      await enter('Ada', 'drive'),
      await enter('Bob', 'drive'),
      await enter('Wim', 'watch'),
    ];
    const may = async (client: Client) => (await client.message('pointing')).may;
    expect([await may(ada), await may(wim)]).toEqual([true, false]);
    const number = await numberOf(bob, 'Ada');
    ada.sendSession({ type: 'point', at: { x: 1.5, y: -2, z: 0 } });
    for (const each of [bob, wim])
      expect(await each.message('pointed')).toEqual({
        type: 'pointed',
        by: number,
        at: { x: 1.5, y: -2, z: 0 },
      });
    wim.sendSession({ type: 'point', at: { x: 0, y: 0, z: 0 } });
    await fault(wim, 'not-permitted');
    await states(ada, 5);
    expect([ada, bob].map(({ session }) => session.filter(({ type }) => type === 'pointed').length)).toEqual([
      0, 1,
    ]);
  });

  it('refuse a request, and know who pressed STOP, which ends what is open', async () => {
    const [ada, bob, wim] = [
      await enter('Ada', 'drive'),
      await enter('Bob', 'drive'),
      await enter('Wim', 'watch'),
    ];
    await bob.takeLease();
    ada.sendSession({ type: 'driveAsk' });
    const { id } = await bob.message('handover', ({ kind }) => kind === 'ask');
    bob.sendSession({ type: 'driveAnswer', id, accept: false });
    await ended(ada, 'refused');
    ada.sendSession({ type: 'driveAsk' });
    await fault(ada, 'rate-limited');

    bob.sendSession({ type: 'driveOffer', to: await numberOf(bob, 'Ada') });
    const last = await ada.message('handover', ({ yours, ended: end }) => !yours && end === undefined);
    wim.sendSession({ type: 'estop', latch: true, press: 1 });
    await ended(ada, 'estop');
    ada.sendSession({ type: 'driveAnswer', id: last.id, accept: true });
    await fault(ada, 'not-open');
    expect(lastLease(bob)).toMatchObject({ holder: 'you' });
    for (const [client, yours] of [
      [bob, false],
      [wim, true],
    ] as const)
      expect(await client.message('estopCause')).toMatchObject({
        pressedBy: 'Wim',
        yours,
        release: 'driver',
      });
    const outcome = (name: string) =>
      metricOf(robot.robot.stack.robotAdminUrl(ID), `farpoint_robot_handovers_total{outcome="${name}"}`);
    expect([await outcome('ask-refused'), await outcome('offer-estop')]).toEqual([1, 1]);
  });
});
