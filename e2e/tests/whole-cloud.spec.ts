import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { OperatorPage } from '../src/operator-page.ts';
import { readPicture } from '../src/picture.ts';
import { cloudsFolder, expect, test } from '../src/stack-test.ts';

const SMALL = '320x180';

/** The whole of the camera's view, at a rate that a software renderer can follow. */
const wholeRobot = {
  id: 'whole',
  name: 'Whole cloud',
  args: ['--source', 'sim', '--sim-seed', '1', '--fps', '8', '--start-mbps', '20', '--bitrate-mbps', '30'],
};

test('the whole cloud arrives, stays where it was captured, and answers a latency test', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [wholeRobot] });
  const operator = await OperatorPage.open(page, stack, { robot: wholeRobot.id, canvas: SMALL, every: '1' });
  await operator.expectPoints(10_000);
  // 480 × 480 pixels, about 15 % of which a stereo camera cannot see.
  await expect.poll(async () => (await operator.stats()).pointsPerFrame).toBeGreaterThan(170_000);
  const { drops } = await operator.stats();
  // Some packets may have arrived before the stream's header, and a busy machine's decoder falls behind.
  const { 'no-stream': _, 'decoder-behind': __, ...others } = drops;
  expect(others).toEqual({});

  // The page's controls cover little of it. Three frames fill the first ring of vertices.
  await operator.expectFrames(5);
  const [facts] = await readPicture(page, await operator.picture(testInfo, 'whole'), [
    { left: 0, top: 0, width: 1, height: 1 },
  ]);
  expect(facts?.drawnShare).toBeGreaterThan(0.4);
  expect(facts?.colours).toBeGreaterThan(50);

  // A room of at most 20 m, with the robot in it.
  const { bounds, camera } = await operator.probe();
  if (bounds === null || camera === null) throw new Error('nothing is drawn');
  for (const axis of [0, 1, 2] as const) {
    expect(bounds.max[axis] - bounds.min[axis]).toBeLessThan(40);
    const at = [camera.x, camera.y, camera.z][axis] as number;
    expect(bounds.min[axis]).toBeLessThan(at + 1);
    expect(bounds.max[axis]).toBeGreaterThan(at - 1);
  }
  expect(bounds.min[2]).toBeGreaterThan(-0.5);

  const result = await page.evaluate(() => window.farpoint.latencyTest());
  expect(result.totalPoints).toBeGreaterThan(100_000);
  expect(result.points).toBe(result.totalPoints);
});

test('an operator that reads only points64 gets it, beside one that gets everything', async ({
  page,
  startStack,
}) => {
  const stack = await startStack({ robots: [wholeRobot] });
  const whole = await OperatorPage.open(page, stack, { robot: wholeRobot.id, canvas: SMALL, every: '8' });
  await whole.expectPoints(10_000);
  const other = await page.context().newPage();
  const plain = await OperatorPage.open(other, stack, {
    robot: wholeRobot.id,
    canvas: SMALL,
    mode: 'points64',
  });
  await plain.expectPoints();
  await expect.poll(async () => (await plain.stats()).pointsPerFrame).toBeLessThan(80_000);
  // The page in the background draws nothing, but the robot keeps sending it everything.
  await page.bringToFront();
  await whole.expectFrames(5);
  await expect.poll(async () => (await whole.stats()).pointsPerFrame).toBeGreaterThan(170_000);
  // The driver decides: now everyone gets points64.
  await other.bringToFront();
  await plain.holdForward();
  await expect.poll(async () => (await plain.state()).holder).toBe('you');
  await expect.poll(async () => (await whole.stats()).pointsPerFrame).toBeLessThan(80_000);
  await plain.release();
});

for (const { name, least } of [
  { name: 'kinect-room', least: 150_000 },
  { name: 'lidar-street', least: 60_000 },
]) {
  test(`a real cloud arrives whole: ${name}`, async ({ page, startStack }, testInfo) => {
    test.skip(!existsSync(cloudsFolder), `no recordings at ${cloudsFolder}`);
    const source = ['--source', 'pcd', '--path', join(cloudsFolder, `${name}.pcd`)];
    const rates = ['--fps', '5', '--start-mbps', '30', '--bitrate-mbps', '60'];
    const stack = await startStack({ robots: [{ id: name, name, args: [...source, ...rates] }] });
    const operator = await OperatorPage.open(page, stack, { robot: name });
    await operator.expectPoints(5000);
    await expect.poll(async () => (await operator.stats()).pointsPerFrame).toBeGreaterThan(least);
    await operator.screenshot(testInfo, name);
  });
}
