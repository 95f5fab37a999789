/** STOP at the real robot program, over a link of which half is gone. All else about STOP: estop-requests.test.ts, scenarios. */
import { EmulatedLink } from '@farpoint/local-stack';
import { expect, it, onTestFinished } from 'vitest';
import { SignaledOperator } from './testing/signaled-operator.ts';
import { useRobot } from './testing/use-robot.ts';

const ROBOT = 'sim-1';
const robot = useRobot(ROBOT, ['--rate-control', 'fixed', '--sim-size', '64', '--max-points', '600']);

it('STOP with only the way to the robot left still stops it, by control alone', {
  timeout: 30_000,
}, async () => {
  const { client: driver } = await robot.connect();
  // Every packet of the other operator goes through a link that can be cut.
  const link = await EmulatedLink.start(robot.stack, { args: ['--rate-mbps', '20', '--rtt-ms', '10'] });
  onTestFinished(() => link.stop());
  const { client } = robot.keep(await SignaledOperator.connect(link.signalingUrl, ROBOT));
  const lease = await driver.takeLease();
  const hand = setInterval(() => driver.drive(lease, 0.1), 20);
  onTestFinished(() => clearInterval(hand));
  await driver.until(() => (driver.telemetry?.twist.linear.x ?? 0) > 0.05);
  link.tell({ type: 'blackhole', direction: 'up', active: true });
  const presses = setInterval(() => client.sendControl({ type: 'estop', press: 1 }), 50);
  onTestFinished(() => clearInterval(presses));
  expect(await driver.message('estop', ({ latched }) => latched)).toMatchObject({ by: 'operator' });
  await driver.until(() => driver.telemetry?.drive === 'estop' && driver.telemetry.twist.linear.x === 0);
});
