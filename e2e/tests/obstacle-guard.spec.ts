/** The robot looks where it goes, and the page says when it does not. */
import { OperatorPage, screenSizes } from '../src/operator-page.ts';
import { expect, simulatedRobot, test } from '../src/stack-test.ts';

test('driven against a wall, the robot stops before it, says why, and backs out', async ({
  page,
  openRobot,
}, testInfo) => {
  const { operator } = await openRobot();
  const bounded = page.locator('#motion-state');
  await expect(page.locator('#obstacle-guard')).toBeHidden();
  await operator.holdForward();
  await expect
    .poll(
      async () => {
        await operator.gripAnew();
        return bounded.textContent();
      },
      { message: 'why the robot stands', intervals: [100] },
    )
    .toBe('Held: something is in the way');
  await operator.expectStanding();
  await operator.look(testInfo, 'held');
  await expect(page.locator('#facts')).not.toContainText('in contact');
  await operator.releaseKeys();
  await expect(bounded).toBeHidden();

  const stood = await operator.body();
  const { keyboard } = page;
  await operator.hold({
    async hold() {
      await keyboard.down(' ');
      await keyboard.down('s');
    },
    async release() {
      await keyboard.up('s');
      await keyboard.up(' ');
    },
  });
  await operator.expectMovedFrom(stood, 0.2);
  await operator.release();
  await operator.expectStanding();
});

test('a robot that does not look says so all the time', async ({ page, startStack }, testInfo) => {
  const robot = { ...simulatedRobot, args: [...simulatedRobot.args, '--obstacle-guard', 'off'] };
  const stack = await startStack({ robots: [robot] });
  const operator = await OperatorPage.open(page, stack, { robot: robot.id });
  await operator.expectPoints();
  const guard = page.locator('#obstacle-guard');
  await expect(guard).toHaveText('The robot does not brake for obstacles');
  for (const { width, height } of screenSizes) {
    await page.setViewportSize({ width, height });
    await expect(guard).toBeInViewport({ ratio: 1 });
    await operator.look(testInfo, `off-${width}`);
  }
});
