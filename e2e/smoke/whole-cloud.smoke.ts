import { OperatorPage } from '../src/operator-page.ts';
import { wholeRobot } from '../src/robots.ts';
import { expect, test } from '../src/smoke-test.ts';

test('each point of a depth camera’s whole cloud arrives, and a latency test finds all of them', async ({
  page,
  shared,
  startRobot,
}, testInfo) => {
  await startRobot(wholeRobot);
  const operator = await OperatorPage.open(page, shared.stack.webUrl, { robot: wholeRobot.id, every: '1' });
  await operator.expectPoints(10_000);
  // 480 × 480 pixels, about 15 % of which a stereo camera cannot see.
  await expect.poll(async () => (await operator.stats()).pointsPerFrame).toBeGreaterThan(170_000);
  // Some packets may arrive before the stream's header, and a busy machine's decoder falls behind.
  const { 'no-stream': _, 'decoder-behind': __, ...others } = (await operator.stats()).drops;
  expect(others).toEqual({});
  await operator.picture(testInfo, 'whole');
  const result = await page.evaluate(() => window.farpoint.latencyTest());
  expect(result.totalPoints).toBeGreaterThan(100_000);
  expect(result.points).toBe(result.totalPoints);
});
