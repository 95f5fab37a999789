import { OperatorPage, screenSizes } from '../src/operator-page.ts';
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
  await operator.look(testInfo, 'two-sensors');

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
  await operator.releaseKeys();
  await operator.expectStanding();
  await page.getByRole('button', { name: 'Camera' }).click();
  await expect.poll(drawn).toEqual([true, true]);
});

test('the sensors’ switches are on every screen, and nothing covers them', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [LIDAR_ROBOT] });
  const operator = await OperatorPage.open(page, stack, { robot: LIDAR_ROBOT.id });
  await operator.expectPoints();
  for (const size of screenSizes) {
    await page.setViewportSize(size);
    await operator.expectFrames(2);
    for (const name of ['Camera', 'LiDAR']) {
      const button = page.getByRole('button', { name, exact: true });
      await expect(button).toBeInViewport({ ratio: 1 });
      await button.click({ trial: true });
    }
    await operator.look(testInfo, `sensors-${size.width}`);
  }
});
