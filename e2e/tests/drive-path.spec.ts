/** The floor before the robot shows what it takes of it, where the hand leads it, and where it would come to stand. */
import { OperatorPage, screenSizes } from '../src/operator-page.ts';
import { expect, lightRobot, simulatedRobot, test } from '../src/stack-test.ts';

test('the way of the present command and its end are on the floor, and turn red where the robot is held', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [lightRobot] });
  const operator = await OperatorPage.open(page, stack, { robot: lightRobot.id });
  await operator.expectPoints(300);
  const path = async () => (await operator.state()).path;
  expect(await path()).toBe(null);
  await operator.holdForward();
  const drives = async (is: (shown: NonNullable<Awaited<ReturnType<typeof path>>>) => boolean) =>
    expect
      .poll(
        async () => {
          await operator.gripAnew();
          const shown = await path();
          return shown !== null && is(shown);
        },
        { intervals: [100] },
      )
      .toBe(true);
  // At 1 m/s: what is gone while the loop is blind, and 0.25 m of braking at 2 m/s².
  await drives(({ stopM, tone }) => tone !== 'held' && stopM > 0.25 && stopM < 1);
  await operator.look(testInfo, 'first-person');
  await page.keyboard.press('t');
  await drives(({ tone }) => tone !== 'held');
  await operator.look(testInfo, 'above');
  await page.keyboard.press('t');
  await drives(({ tone }) => tone === 'held');
  await operator.look(testInfo, 'held');
  await operator.releaseKeys();
  await expect.poll(path).toBe(null);
});

test('a robot of a configured outline shows that, and not a usual robot', async ({
  page,
  startStack,
}, testInfo) => {
  const outline = '0.6,0.4 -0.6,0.4 -0.6,-0.4 0.6,-0.4';
  const robot = { ...simulatedRobot, args: [...simulatedRobot.args, '--footprint', outline] };
  const stack = await startStack({ robots: [robot] });
  const operator = await OperatorPage.open(page, stack, { robot: robot.id });
  await operator.expectPoints();
  await page.keyboard.press('t');
  await operator.expectFrames(5);
  for (const { width, height } of screenSizes) {
    await page.setViewportSize({ width, height });
    await operator.look(testInfo, `outline-${width}`);
  }
});
