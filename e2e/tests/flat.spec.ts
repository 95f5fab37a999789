import { OperatorPage } from '../src/operator-page.ts';
import { readPicture } from '../src/picture.ts';
import { expect, test } from '../src/stack-test.ts';

const wholePage = { left: 0, top: 0, width: 1, height: 1 };

test('on a flat screen: choose the robot, see its world, drive it with the keyboard', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack();
  const operator = await OperatorPage.open(page, stack);
  await page.getByRole('button', { name: /Simulated robot 1/ }).click();
  await operator.expectPoints(5000);

  const before = await operator.screenshot(testInfo, 'room');
  const [room] = await readPicture(page, before, [wholePage]);
  expect(room?.drawnShare).toBeGreaterThan(0.3);
  expect(room?.colours).toBeGreaterThan(20);

  const start = await operator.body();
  await operator.holdForward();
  await operator.expectState('holder', 'you');
  await operator.expectMovedFrom(start, 0.5);
  await operator.releaseKeys();
  await operator.expectStanding();
  await operator.look(testInfo, 'after-driving');

  // Forward means along its initial heading.
  const end = await operator.body();
  const heading = Math.atan2(end.y - start.y, end.x - start.x);
  expect(Math.cos(heading - start.yaw)).toBeGreaterThan(0.99);
});

test('without the dead-man key nothing moves', async ({ page, openRobot }) => {
  const { operator } = await openRobot();
  const start = await operator.body();
  await page.keyboard.down('KeyW');
  await operator.expectFrames(30);
  await page.keyboard.up('KeyW');
  const end = await operator.body();
  expect(Math.hypot(end.x - start.x, end.y - start.y)).toBe(0);
});

test('the latency test turns the next cloud green and reports motion-to-photon latency', async ({
  page,
  openRobot,
}) => {
  await openRobot();
  const result = await page.evaluate(() => window.farpoint.latencyTest());
  expect(result.points).toBeGreaterThan(1000);
  expect(result.points).toBeLessThanOrEqual(result.totalPoints);
  expect(result.robot?.frameNumber).toBe(result.frameNumber);
  expect(result.firstMs).toBeGreaterThan(0);
  expect(result.mtpMs).toBeGreaterThanOrEqual(result.firstMs);
  // As an operator requests it.
  await page.keyboard.press('KeyL');
  await expect.poll(() => page.evaluate(() => window.farpoint.latencyResults().length)).toBe(2);
});

test('the emergency stop latches until it is released on purpose', async ({ page, openRobot }) => {
  const { operator } = await openRobot();
  const start = await operator.body();
  await operator.holdForward();
  await operator.expectMovedFrom(start, 0.2);
  await page.keyboard.press('KeyX');
  await operator.expectState('estop', true);
  await operator.expectStanding();
  await operator.expectState('drive', 'estop');

  // Neither held keys nor newly pressed keys move it.
  await operator.releaseKeys();
  const stopped = await operator.body();
  await operator.holdForward();
  await operator.expectFrames(30);
  expect(await operator.body()).toEqual(stopped);
  await operator.releaseKeys();

  await operator.releaseEstop();
  await operator.holdForward();
  await operator.expectMovedFrom(stopped, 0.2);
  await operator.releaseKeys();
});
