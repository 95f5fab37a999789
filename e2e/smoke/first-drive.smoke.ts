/** What a newcomer does first, by hand. */
import { expectStanding, OperatorPage, poseOf } from '../src/operator-page.ts';
import { robotLike } from '../src/robots.ts';
import { expect, test } from '../src/smoke-test.ts';

test('choose the robot, see its world, drive it by keys, stop it, release the stop, measure', async ({
  page,
  shared,
  startRobot,
}, testInfo) => {
  const { name } = await startRobot(robotLike('first'));
  const operator = await OperatorPage.open(page, shared.stack.webUrl);
  await page.getByRole('button', { name }).click();
  await operator.expectPoints();

  const start = await poseOf(operator);
  await operator.hold(operator.keys);
  await operator.expectState('holder', 'you');
  await operator.expectMovedFrom(start, 0.2);
  await operator.release();
  await expectStanding(operator);
  await operator.picture(testInfo, 'after-driving');
  // Forward means along its initial heading.
  const end = await poseOf(operator);
  expect(Math.cos(Math.atan2(end.y - start.y, end.x - start.x) - start.yaw)).toBeGreaterThan(0.99);

  await page.keyboard.press('KeyX');
  await operator.expectState('estop', true);
  await operator.cannotDrive();
  await operator.releaseEstop();
  await operator.drives(0.05);

  await page.keyboard.press('KeyL');
  await expect.poll(() => page.evaluate(() => window.farpoint.latencyResults().length)).toBe(1);
  const [result] = await page.evaluate(() => window.farpoint.latencyResults());
  expect(result?.points).toBe(result?.totalPoints);
});
