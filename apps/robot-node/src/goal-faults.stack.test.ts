/**
 * What goes wrong on the way to a goal, and how soon the robot brakes: at the real program, as another operator sees it.
 * It tells its state 20 times a second, so a time is known to 50 ms.
 */
import { EmulatedLink } from '@farpoint/local-stack';
import { afterAll, afterEach, beforeAll, describe, expect, test } from 'vitest';
import { BRAKES_MS } from './testing/faults/fault.ts';
import { FaultTimes } from './testing/faults/fault-times.ts';
import { goalFaults } from './testing/faults/goal-faults.ts';
import { GoalHand } from './testing/goal-hand.ts';
import { metricOf } from './testing/metric-of.ts';
import { SignaledOperator } from './testing/signaled-operator.ts';
import { useRobot } from './testing/use-robot.ts';

const ID = 'sim-1';
const ARGS = [
  ...['--rate-control', 'fixed', '--sim-size', '64', '--max-points', '600'],
  // A cart would come and wait in front of a robot that stands.
  ...['--goals', 'sim', '--take-policy', 'always', '--estop-release', 'driver', '--obstacle-guard', 'off'],
];
/** Between two states, and what a busy machine may add, ms. */
const [STATE_MS, BUSY_MS] = [50, 500];
/**
 * How far ahead of where it begins the other of two places is, m: far enough for it to be fast when something goes wrong.
 * There is furniture farther ahead.
 */
const OTHER_M = 0.7;
/** The robot is on its way at this speed, and brakes when it is slower than it was by so much, m/s. */
const [GOING, SLOWER] = [0.3, 0.02];
/** Tries to get it going, on a machine whose pauses end a goal. */
const TRIES = 8;
/** States of a robot that stays. */
const STANDS_FOR = 12;

describe('faults on the way to a goal', { timeout: 90_000 }, () => {
  const robot = useRobot(ID, ARGS);
  const times = new FaultTimes();
  let link: EmulatedLink;
  let hand: GoalHand | null = null;
  let home: { x: number; y: number } | null = null;

  beforeAll(async () => {
    link = await EmulatedLink.start(robot.stack, { args: ['--rate-mbps', '20', '--rtt-ms', '10'] });
  }, 30_000);
  afterEach(() => {
    hand?.letGo();
    link.tell({ type: 'blackhole', direction: 'both', active: false });
  });
  afterAll(async () => {
    console.log(`from the cause to braking, ms:\n${times.text()}`);
    times.save();
    await link.stop();
  }, 30_000);

  const ended = (reason: string) =>
    metricOf(robot.stack.robotAdminUrl(ID), `farpoint_robot_goals_ended_total{reason="${reason}"}`);
  const endedBy = async (reasons: readonly string[]) =>
    (await Promise.all(reasons.map(ended))).reduce((sum, count) => sum + count, 0);

  test.each(goalFaults)('$name: brakes and stays', async (fault) => {
    const { name, reasons, withinMs = BRAKES_MS, behindLink = false, cause } = fault;
    const witness = (await robot.connect()).client;
    await witness.until(() => witness.telemetry !== null);
    const twist = () => witness.telemetry?.twist ?? { linear: { x: 0 }, angular: { z: 0 } };
    const speed = () => Math.abs(twist().linear.x);
    const stands = () => witness.until(() => speed() === 0 && twist().angular.z === 0);

    const url = behindLink ? link.signalingUrl : robot.stack.signalingUrl;
    const driver = robot.keep(await SignaledOperator.connect(url, ID));
    const { client } = driver;
    client.sendSession({ type: 'leaseRequest', take: true });
    hand = await GoalHand.of(client);
    // Only who drives may release what a row before has latched.
    const { latched } = await client.message('estop');
    if (latched) client.releaseEstop();
    await client.until(() => client.session.findLast((each) => each.type === 'estop')?.latched === false);
    for (let tries = 1; ; tries++) {
      const at = client.telemetry?.pose.position ?? { x: Number.NaN, y: Number.NaN };
      home ??= { x: at.x, y: at.y };
      // To the farther of its two places.
      const x = at.x - home.x > OTHER_M / 2 ? home.x : home.x + OTHER_M;
      hand.go(x - at.x, home.y - at.y);
      try {
        await hand.until(() => speed() > GOING);
        break;
      } catch (error) {
        // As a driver would on such a machine: it stands, and is sent again.
        if (tries === TRIES) throw error;
        await stands();
      }
    }

    const before = await endedBy(reasons);
    const fast = speed();
    let causeMs = performance.now();
    const beganMs = await cause({ driver, hand, link, connect: () => robot.connect() });
    if (typeof beganMs === 'number') causeMs = beganMs;
    await witness.until(() => speed() < fast - SLOWER);
    const afterMs = performance.now() - causeMs;
    times.add(`on the way to a goal: ${name}`, afterMs, withinMs + STATE_MS);
    expect(afterMs).toBeLessThanOrEqual(withinMs + STATE_MS + BUSY_MS);

    await stands();
    const stood = witness.telemetry?.pose.position;
    const { sequence = 0 } = witness.telemetry ?? {};
    await witness.until(() => (witness.telemetry?.sequence ?? 0) >= sequence + STANDS_FOR);
    expect(witness.telemetry?.pose.position).toEqual(stood);
    expect(await endedBy(reasons)).toBe(before + 1);
  });
});
