import { OperatorPage } from '../src/operator-page.ts';
import { savesPictures, screenSizes } from '../src/screens.ts';
import { expect, simulatedRobot, test } from '../src/stack-test.ts';

const LIDAR_ROBOT = { ...simulatedRobot, args: [...simulatedRobot.args, '--sim-lidars', '1'] };

test('a camera and a LiDAR in one session: both drawn, each switched off and on without the other', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [LIDAR_ROBOT] });
  const operator = await OperatorPage.open(page, stack, { robot: LIDAR_ROBOT.id });
  await operator.expectPoints();
  const sensors = () => page.evaluate(() => window.farpoint.sensors());
  const drawn = async () => (await sensors()).map(({ points }) => points > 0);
  await expect.poll(drawn).toEqual([true, true]);
  expect((await sensors()).map(({ name, wanted }) => [name, wanted])).toEqual([
    ['Camera', true],
    ['LiDAR', true],
  ]);
  if (savesPictures) await page.screenshot({ path: testInfo.outputPath('two-sensors.png') });

  await page.getByRole('button', { name: 'LiDAR' }).click();
  await expect.poll(drawn).toEqual([true, false]);
  const before = (await operator.stats()).framesDrawn;
  await expect.poll(async () => (await operator.stats()).framesDrawn).toBeGreaterThan(before + 5);

  await page.getByRole('button', { name: 'LiDAR' }).click();
  await page.getByRole('button', { name: 'Camera' }).click();
  await expect.poll(drawn).toEqual([false, true]);

  // The robot can be driven with the remaining sensor, and the choice outlives the session.
  const start = await operator.body();
  await operator.holdForward();
  await operator.expectMovedFrom(start, 0.2);
  await operator.release();
  await operator.expectStanding();
  await page.getByRole('button', { name: 'Camera' }).click();
  await expect.poll(drawn).toEqual([true, true]);
});

for (const { width, height } of screenSizes) {
  test(`the sensors' switches are on a screen ${width} pixels wide`, async ({
    page,
    startStack,
  }, testInfo) => {
    await page.setViewportSize({ width, height });
    const stack = await startStack({ robots: [LIDAR_ROBOT] });
    const operator = await OperatorPage.open(page, stack, { robot: LIDAR_ROBOT.id });
    await operator.expectPoints();
    for (const name of ['Camera', 'LiDAR']) {
      const button = page.getByRole('button', { name, exact: true });
      await expect(button).toBeInViewport({ ratio: 1 });
      // Nothing covers it.
      await button.click({ trial: true });
    }
    if (savesPictures) await page.screenshot({ path: testInfo.outputPath(`sensors-${width}.png`) });
  });
}
