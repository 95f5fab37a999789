/** The robot moves only while its driver sees it: a page that draws nothing any more brakes it, and says why. */
import { freezeFrames, thawFrames } from '../src/frames.ts';
import { OperatorPage, screenSizes } from '../src/operator-page.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';

// For a software-rendered page, which is late by itself.
const args = ['--view-slow-ms', '1000', '--view-brake-ms', '1500', '--view-stall-ms', '700'];
const robot = { ...lightRobot, args: [...lightRobot.args, ...args] };

test('a page that draws nothing any more brakes the robot, until the grip is let go', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [robot] });
  const operator = await OperatorPage.open(page, stack, { robot: robot.id });
  await operator.expectPoints(300);
  const bounded = page.locator('#motion-state');
  const start = await operator.body();
  await operator.holdForward();
  await operator.expectMovedFrom(start, 0.2);
  await expect(bounded).toBeHidden();

  await freezeFrames(page);
  await operator.expectStanding();
  // A busy machine may read the keys too late, which lets go.
  await expect(async () => {
    await operator.gripAnew();
    await expect(bounded).toHaveText('Held: what you see is too old. Let go, then drive', { timeout: 1000 });
  }).toPass();
  await expect(page.locator('#facts')).toContainText('Held: what you see is too old');
  for (const { width, height } of screenSizes) {
    await page.setViewportSize({ width, height });
    await expect(async () => {
      await operator.gripAnew();
      await expect(bounded).toBeInViewport({ ratio: 1, timeout: 1000 });
    }).toPass();
    await operator.look(testInfo, `held-${width}`);
  }

  // Drawn again: the robot stays until the hand has let go.
  await thawFrames(page);
  await operator.expectFrames(10);
  const stood = await operator.body();
  await page.setViewportSize({ width: 960, height: 540 });
  await operator.expectFrames(10);
  expect(Math.hypot((await operator.body()).x - stood.x, (await operator.body()).y - stood.y)).toBeLessThan(
    0.01,
  );
  await operator.releaseKeys();
  await expect(bounded).toBeHidden();
  await operator.holdForward();
  await operator.expectMovedFrom(stood, 0.2);
  await operator.releaseKeys();
  await operator.expectStanding();
});
