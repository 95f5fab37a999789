/** STOP and gaps in the commands, at the real robot program: processes, sockets, WebRTC. */

import { EmulatedLink } from '@farpoint/local-stack';
import type { EstopState } from '@farpoint/protocol';
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { SignaledOperator } from './testing/signaled-operator.ts';
import { useRobot } from './testing/use-robot.ts';

const ROBOT = 'sim-1';
const ARGS = ['--rate-control', 'fixed', '--sim-size', '64', '--max-points', '600'];
const robot = useRobot(ROBOT, ARGS);

let link: EmulatedLink | null = null;
afterEach(async () => {
  await link?.stop();
  link = null;
});

// A test that failed has left the robot stopped; the next one is not to fail of that.
beforeEach(async () => {
  const operator = await robot.connect();
  const { latched } = await operator.client.message('estop');
  if (latched) {
    await operator.client.takeLease();
    operator.client.releaseEstop();
    await untilLatched(operator, false);
    operator.client.sendSession({ type: 'leaseRelease' });
  }
  await operator.close();
});

/** An operator whose every packet goes through a link that can be cut. */
async function connectBehindLink(): Promise<{ operator: SignaledOperator; cut: EmulatedLink }> {
  link = await EmulatedLink.start(robot.stack, { args: ['--rate-mbps', '20', '--rtt-ms', '10'] });
  const operator = robot.keep(await SignaledOperator.connect(link.signalingUrl, ROBOT));
  return { operator, cut: link };
}

/** Resolves once this is what the robot last said about its emergency stop. */
async function untilLatched({ client }: SignaledOperator, latched: boolean): Promise<EstopState> {
  const newest = () => client.session.findLast((message): message is EstopState => message.type === 'estop');
  await client.until(() => newest()?.latched === latched);
  return newest() as EstopState;
}

/** Drives until the robot is seen to move; then keeps driving until the returned function is called. */
async function driving({ client }: SignaledOperator, lease: string): Promise<() => void> {
  const timer = setInterval(() => client.drive(lease, 0.1), 20);
  await client.until(() => (client.telemetry?.twist.linear.x ?? 0) > 0.05);
  return () => clearInterval(timer);
}

describe('STOP', { timeout: 30_000 }, () => {
  it('by control alone, with nothing from the session channel, stops a robot that another drives', async () => {
    const [driver, other] = [await robot.connect(), await robot.connect()];
    const lease = await driver.client.takeLease();
    const end = await driving(driver, lease);
    try {
      const acks: unknown[] = [];
      other.client.control.onMessage.subscribe((data) => void acks.push(JSON.parse(data.toString())));
      other.client.sendControl({ type: 'estop', press: 1 });
      await other.client.until(() => acks.some((ack) => (ack as { type: string }).type === 'estopAck'));
      expect(acks).toContainEqual({ type: 'estopAck', press: 1 });
      const state = await untilLatched(driver, true);
      expect(state).toMatchObject({ by: 'operator', latch: expect.any(Number) });
      await driver.client.until(() => driver.client.telemetry?.drive === 'estop');
      await driver.client.until(() => driver.client.telemetry?.twist.linear.x === 0);

      // The same press by the other channel, late: it changes nothing, whether latched or released.
      other.client.sendSession({ type: 'estop', latch: true, press: 1 });
      driver.client.releaseEstop();
      expect(await untilLatched(driver, false)).toMatchObject({ latch: state.latch });
      other.client.sendControl({ type: 'estop', press: 1 });
      const before = acks.length;
      await other.client.until(() => acks.length > before);
      expect(driver.client.session.findLast(({ type }) => type === 'estop')).toMatchObject({
        latched: false,
      });
    } finally {
      end();
    }
  });

  it('with only the way to the robot left, still stops it', async () => {
    const driver = await robot.connect();
    const { operator, cut } = await connectBehindLink();
    const lease = await driver.client.takeLease();
    const end = await driving(driver, lease);
    try {
      cut.tell({ type: 'blackhole', direction: 'up', active: true });
      operator.client.sendControl({ type: 'estop', press: 1 });
      const repeats = setInterval(() => operator.client.sendControl({ type: 'estop', press: 1 }), 50);
      try {
        await untilLatched(driver, true);
      } finally {
        clearInterval(repeats);
      }
      driver.client.releaseEstop();
      await untilLatched(driver, false);
    } finally {
      end();
    }
  });

  it('pressed while the path is away arrives at its return, once', async () => {
    const driver = await robot.connect();
    const { operator, cut } = await connectBehindLink();
    const { latch: first } = await untilLatched(driver, false);
    const sequenceAt = ({ client }: SignaledOperator) => client.telemetry?.sequence ?? 0;
    await operator.client.until(() => sequenceAt(operator) > 0);
    cut.tell({ type: 'blackhole', direction: 'both', active: true });
    await driver.client.until(() => sequenceAt(driver) > sequenceAt(operator) + 3);
    operator.client.sendSession({ type: 'estop', latch: true, press: 1 });
    operator.client.sendControl({ type: 'estop', press: 1 });
    // The driver, whose path is well, hears of no STOP while the other's is away.
    const sequence = sequenceAt(driver);
    await driver.client.until(() => sequenceAt(driver) > sequence + 20);
    expect(driver.client.session.findLast(({ type }) => type === 'estop')).toMatchObject({ latch: first });
    cut.tell({ type: 'blackhole', direction: 'both', active: false });
    const repeats = setInterval(() => operator.client.sendControl({ type: 'estop', press: 1 }), 50);
    try {
      await operator.client.message('estop', ({ press }) => press === 1);
    } finally {
      clearInterval(repeats);
    }
    expect(await untilLatched(driver, true)).toMatchObject({ latch: (first ?? 0) + 1 });
    await driver.client.takeLease();
    driver.client.releaseEstop();
    await untilLatched(driver, false);
  });

  it('is not undone by a release that was on its way', async () => {
    const [driver, other] = [await robot.connect(), await robot.connect()];
    await driver.client.takeLease();
    other.client.sendSession({ type: 'estop', latch: true, press: 1 });
    const { latch } = await untilLatched(driver, true);
    other.client.sendSession({ type: 'estop', latch: true, press: 2 });
    const newer = (latch ?? 0) + 1;
    await driver.client.message('estop', (state) => state.latch === newer);
    driver.client.sendSession({ type: 'estop', latch: false, of: latch });
    await driver.client.message('fault', ({ reason }) => reason === 'newer-latch');
    expect(await untilLatched(driver, true)).toMatchObject({ latch: newer });
    driver.client.sendSession({ type: 'estop', latch: false, of: newer });
    await untilLatched(driver, false);
  });
});

it('after a gap that stopped the robot, moves again only once the hand has let go', {
  timeout: 30_000,
}, async () => {
  const driver = await robot.connect();
  const { client } = driver;
  expect((await client.message('welcome')).limits).toMatchObject({
    watchdogMs: 150,
    afterGap: 'let-go',
    resumeWithinMs: 400,
  });
  const lease = await client.takeLease();
  (await driving(driver, lease))();
  await client.until(() => client.telemetry?.drive === 'watchdog');
  await client.until(() => client.telemetry?.motion?.letGoFirst === true);
  expect(client.telemetry?.twist.linear.x).toBe(0);
  const { length } = client.session;
  client.drive(lease, 0.1);
  await client.until(() =>
    client.session.slice(length).some((each) => each.type === 'rejected' && each.reason === 'let-go-first'),
  );
  const { sequence } = client.telemetry ?? { sequence: 0 };
  await client.until(() => (client.telemetry?.sequence ?? 0) > sequence + 2);
  expect(client.telemetry?.twist.linear.x).toBe(0);
  // The next command shows the hand open; after that, the robot drives.
  (await driving(driver, lease))();
});
