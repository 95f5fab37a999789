/** Goals at the real robot program: it drives there under guard, for as long as its driver holds on, and never later. */
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, afterEach, describe, expect, it } from 'vitest';
import { GoalHand } from './testing/goal-hand.ts';
import { metricOf } from './testing/metric-of.ts';
import type { SignaledOperator } from './testing/signaled-operator.ts';
import { useRobot } from './testing/use-robot.ts';

const ID = 'sim-1';
const folder = mkdtempSync(join(tmpdir(), 'farpoint-goals-'));
const auditLog = join(folder, 'audit.jsonl');
afterAll(() => rmSync(folder, { recursive: true }));

const SMALL = ['--rate-control', 'fixed', '--sim-size', '64', '--max-points', '600'];
/** Hands on a busy machine have pauses, at which the robot rightly ends a goal. */
const PATIENT = [
  ...['--watchdog-ms', '800', '--view-slow-ms', '1000', '--view-brake-ms', '2500', '--view-stall-ms', '1500'],
];
/** From the last hold to braking, and what a busy machine may add, ms. */
const [BRAKES_MS, BUSY_MS] = [200, 300];
/** There is furniture farther ahead, m. */
const NEAR_M = 0.6;

type Client = SignaledOperator['client'];
const place = ({ telemetry }: Client) => telemetry?.pose.position ?? { x: Number.NaN, y: Number.NaN };
const between = (a: { x: number; y: number }, b: { x: number; y: number }) =>
  Math.hypot(a.x - b.x, a.y - b.y);
const stands = (client: Client) =>
  client.until(() => {
    const { linear, angular } = client.telemetry?.twist ?? { linear: { x: 1 }, angular: { z: 1 } };
    return linear.x === 0 && angular.z === 0;
  });
const drives = (client: Client) => client.until(() => Math.abs(client.telemetry?.twist.linear.x ?? 0) > 0.2);

/** Resolves after the robot has sent its state so often again. */
async function states(client: Client, count: number): Promise<void> {
  const { sequence } = client.telemetry ?? { sequence: 0 };
  await client.until(() => (client.telemetry?.sequence ?? 0) >= sequence + count);
}

/** The robot stands, and stays where it is although somebody holds on. */
async function expectStaying(client: Client): Promise<void> {
  await stands(client);
  const stood = place(client);
  await states(client, 20);
  expect(between(place(client), stood)).toBeLessThan(0.005);
}

describe('a robot that takes goals', { timeout: 60_000 }, () => {
  const robot = useRobot(ID, [
    ...[...SMALL, ...PATIENT, '--goals', 'sim', '--take-policy', 'always', '--audit-log', auditLog],
  ]);
  const metric = (name: string) => metricOf(robot.stack.robotAdminUrl(ID), `farpoint_robot_${name}`);
  const hands: GoalHand[] = [];
  afterEach(() => {
    for (const hand of hands.splice(0)) hand.letGo();
  });
  const goalHand = async (client: Client) => {
    const hand = await GoalHand.of(client);
    hands.push(hand);
    return hand;
  };

  it('says so, drives to one, and says that it is there', async () => {
    const { client } = await robot.connect();
    const hand = await goalHand(client);
    expect(client.session.find(({ type }) => type === 'welcome')).toMatchObject({ goals: { mostM: 20 } });
    const from = place(client);
    hand.go(NEAR_M);
    await hand.told('accepted');
    await hand.told('driving');
    await hand.told('reached');
    await expectStaying(client);
    expect(Math.abs(between(place(client), from) - NEAR_M)).toBeLessThan(0.2);
    expect(await metric('goals_taken_total')).toBe(1);
    expect(await metric('goals_ended_total{reason="reached"}')).toBe(1);
    // And back: it turns first.
    hand.go(-NEAR_M);
    await hand.told('reached');
    expect(between(place(client), from)).toBeLessThan(0.35);
  });

  it('stands for STOP, and its release moves nothing', async () => {
    const { client } = await robot.connect();
    const hand = await goalHand(client);
    hand.go(NEAR_M);
    await drives(client);
    const other = await robot.connect();
    other.client.sendSession({ type: 'estop', latch: true });
    expect((await hand.told('cancelled')).reason).toBe('estop');
    await stands(client);
    hand.go(NEAR_M);
    expect((await hand.told('refused')).reason).toBe('estop');
    client.releaseEstop();
    await client.message('estop', ({ latched }) => !latched);
    await expectStaying(client);
    hand.go(-NEAR_M / 2);
    await hand.told('reached');
  });

  it('stands for its driver’s own hand, and when the goal is taken back', async () => {
    const { client } = await robot.connect();
    const hand = await goalHand(client);
    hand.go(NEAR_M);
    await hand.told('driving');
    client.drive(hand.lease, 0.1);
    expect((await hand.told('cancelled')).reason).toBe('stick');
    await expectStaying(client);
    hand.go(-NEAR_M / 2);
    await hand.told('driving');
    client.sendSession({ type: 'goalCancel', id: hand.id });
    expect((await hand.told('cancelled')).reason).toBe('asked');
    await expectStaying(client);
  });

  it('stands when somebody else takes over', async () => {
    const { client } = await robot.connect();
    const hand = await goalHand(client);
    hand.go(NEAR_M);
    await hand.told('driving');
    const other = await robot.connect();
    other.client.sendSession({ type: 'leaseRequest', take: true });
    expect((await hand.told('cancelled')).reason).toBe('lease-lost');
    await expectStaying(client);
    hand.go(NEAR_M);
    expect((await hand.told('refused')).reason).toBe('not-lease-holder');
  });

  it('stands when its driver’s session ends', async () => {
    const driver = await robot.connect();
    const hand = await goalHand(driver.client);
    hand.go(-NEAR_M);
    await hand.told('driving');
    const { client } = await robot.connect();
    await client.until(() => client.telemetry !== null);
    await driver.close();
    await expectStaying(client);
  });

  it('refuses what it cannot or must not do, by reason, and nothing moves', async () => {
    const driver = await robot.connect();
    const { client } = driver;
    const hand = await goalHand(client);
    const guest = (await robot.connect()).client;
    const refused = (id: number) => guest.message('goalState', (each) => each.id === id);
    const goal = { type: 'goal', timeMs: performance.now(), x: 0, y: 0 } as const;
    guest.sendSession({ ...goal, id: 1, lease: 'x'.repeat(22) });
    expect(await refused(1)).toMatchObject({ state: 'refused', reason: 'not-lease-holder' });
    guest.sendSession({ ...goal, id: 2, lease: hand.lease });
    expect(await refused(2)).toMatchObject({ state: 'refused', reason: 'not-lease-holder' });
    hand.go(20.5);
    expect((await hand.told('refused')).reason).toBe('too-far');
    hand.go(0.5, 0, { id: 1 });
    await client.message('goalState', ({ state, reason }) => state === 'refused' && reason === 'repeated');
    hand.go(0.5, 0, { timeMs: 0 });
    expect((await hand.told('refused')).reason).toBe('stale');
    for (const x of ['NaN', '1e999', 'null', '"1"', '[]', '1e308']) {
      const text = JSON.stringify({ ...goal, id: 9, lease: hand.lease, x: 'X' }).replace('"X"', x);
      client.sendSession(JSON.parse(text.replace(/:(NaN|1e999),/, ':null,')) as never);
    }
    for (let id = 100; id < 140; id++) guest.sendSession({ ...goal, id, lease: hand.lease });
    await guest.message('goalState', ({ reason }) => reason === 'rate-limited');
    // Holds of goals that never were.
    for (let id = 0; id < 5; id++) client.sendControl(client.hand.hold(hand.lease, 2 ** 31 + id));
    await expectStaying(client);
    expect(await metric('goals_refused_total{reason="too-far"}')).toBe(1);
    expect(await metric('goals_refused_total{reason="not-lease-holder"}')).toBeGreaterThanOrEqual(3);
    expect(await metric('goal_active')).toBe(0);
  });

  it('has written everything to its audit log', async () => {
    const kinds = readFileSync(auditLog, 'utf8').match(/"kind":"goal-[a-z]+"/g) ?? [];
    for (const kind of ['taken', 'refused', 'ended']) expect(kinds).toContain(`"kind":"goal-${kind}"`);
    const count = (kind: string) => kinds.filter((each) => each === `"kind":"goal-${kind}"`).length;
    expect(count('taken')).toBe(count('ended'));
  });
});

describe('a robot whose driver’s page is silent', { timeout: 60_000 }, () => {
  const robot = useRobot(ID, [...SMALL, '--goals', 'sim']);

  it('stands at once when its driver’s page is silent, and for good', async () => {
    const { client } = await robot.connect();
    const hand = await GoalHand.of(client);
    hand.go(NEAR_M);
    await drives(client);
    const last = place(client);
    hand.letGo();
    const silentMs = performance.now();
    const { reason } = await hand.told('cancelled');
    expect(reason).toBe('silence');
    // It is said when the wheels are told.
    expect(performance.now() - silentMs).toBeLessThan(BRAKES_MS + BUSY_MS);
    await stands(client);
    // At 0.5 m/s: a state's age, the watchdog's 150 ms, and the way to brake.
    expect(between(place(client), last)).toBeLessThan(0.25);
    hand.hold();
    await expectStaying(client);
    hand.letGo();
  });
});

describe('a robot with something in its way', { timeout: 60_000 }, () => {
  const robot = useRobot(ID, [
    ...[...SMALL, ...PATIENT, '--goals', 'sim', '--sim-things', '1.2,0,1', '--goals-max-m', '3'],
  ]);

  it('stops before it, says so, and does not go on by itself', async () => {
    const { client } = await robot.connect();
    const hand = await GoalHand.of(client);
    const from = place(client);
    try {
      hand.go(3.5);
      expect((await hand.told('refused')).reason).toBe('too-far');
      hand.go(2.5);
      expect((await hand.told('blocked')).reason).toBe('obstacle');
      await expectStaying(client);
      expect(place(client).x - from.x).toBeLessThan(1);
    } finally {
      hand.letGo();
    }
  });
});

describe('a robot that takes none', { timeout: 60_000 }, () => {
  const robot = useRobot(ID, SMALL);

  it('says nothing of goals, and refuses them', async () => {
    const { client } = await robot.connect();
    const hand = await GoalHand.of(client);
    try {
      expect(client.session.find(({ type }) => type === 'welcome')).not.toHaveProperty('goals');
      hand.go(NEAR_M);
      expect((await hand.told('refused')).reason).toBe('off');
      await expectStaying(client);
    } finally {
      hand.letGo();
    }
  });
});
