/** On a recorded street, the grid lies on the ground that is seen, and the view from above fits how far the cloud reaches. */
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { OperatorPage } from '../src/operator-page.ts';
import { cloudsFolder, expect, test } from '../src/stack-test.ts';

const STREAM = ['--mode', 'points64', '--fps', '5', '--bitrate-mbps', '40', '--lambda', '0'];
const scene = async (operator: OperatorPage) => (await operator.state()).scene;

function playedRobot(path: string) {
  return { id: 'lidar', name: 'LiDAR', args: ['--source', 'pcd', '--path', path, ...STREAM] };
}

test('a recorded street', async ({ page, startStack }, testInfo) => {
  test.skip(!existsSync(cloudsFolder), `no recordings at ${cloudsFolder}`);
  const robot = playedRobot(join(cloudsFolder, 'lidar-street.pcd'));
  const stack = await startStack({ robots: [robot] });
  const operator = await OperatorPage.open(page, stack, { robot: robot.id });
  await operator.expectPoints(60_000);
  // The sensor was 1.7 to 1.9 m above the street.
  await expect.poll(async () => (await scene(operator)).gridM, { message: 'the grid' }).toBeLessThan(-0.55);
  expect((await scene(operator)).gridM).toBeGreaterThan(-1);
  expect((await scene(operator)).reachM).toBeGreaterThan(15);
  await operator.screenshot(testInfo, 'street');
  await page.keyboard.press('t');
  await operator.expectFrames(2);
  await operator.screenshot(testInfo, 'street-above');
});
