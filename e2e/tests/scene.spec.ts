/** The grid lies on the ground that is seen, and the views from outside fit how far the clouds reach. */
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import type { Page, TestInfo } from '@playwright/test';
import { lidarYard, writeLidarYard } from '../src/lidar-yard.ts';
import { OperatorPage, screenSizes } from '../src/operator-page.ts';
import { cloudsFolder, expect, simulatedRobot, test } from '../src/stack-test.ts';

const STREAM = ['--mode', 'points64', '--fps', '5', '--bitrate-mbps', '40', '--lambda', '0'];
/** Without anything to fit: `DEFAULT_REACH`, and slightly below the robot's base. */
const USUAL = { gridM: -0.01, reachM: 6 };

const scene = async (operator: OperatorPage) => (await operator.state()).scene;

function playedRobot(path: string) {
  return { id: 'lidar', name: 'LiDAR', args: ['--source', 'pcd', '--path', path, ...STREAM] };
}

async function pictures(page: Page, operator: OperatorPage, testInfo: TestInfo, name: string): Promise<void> {
  for (const size of screenSizes) {
    await page.setViewportSize(size);
    await operator.expectFrames(2);
    await operator.look(testInfo, `${name}-${size.width}`);
  }
  await page.setViewportSize({ width: 960, height: 540 });
}

test('a LiDAR over ground that its robot does not know of: the grid lies on it, and the yard fits the screen', async ({
  page,
  startStack,
}, testInfo) => {
  const path = testInfo.outputPath('yard.pcd');
  writeLidarYard(path);
  const robot = playedRobot(path);
  const stack = await startStack({ robots: [robot] });
  const operator = await OperatorPage.open(page, stack, { robot: robot.id });
  await operator.expectPoints(5000);
  await expect
    .poll(async () => Math.abs((await scene(operator)).gridM - lidarYard.groundM), {
      message: 'off the ground',
    })
    .toBeLessThan(0.1);
  // The estimate grows with each cloud.
  await expect.poll(async () => (await scene(operator)).reachM).toBeGreaterThan(lidarYard.wallM);
  await operator.expectFrames(30);
  const { reachM } = await scene(operator);
  // A few points are 120 m away.
  expect(reachM).toBeLessThan(40);
  await pictures(page, operator, testInfo, 'eye');
  await page.keyboard.press('v');
  await operator.expectFrames(2);
  await operator.look(testInfo, 'third-person');
  await page.keyboard.press('v');
  await page.keyboard.press('t');
  await pictures(page, operator, testInfo, 'above');
  // The operator's own zoom stays until it is reset.
  await page.locator('#stage').hover({ position: { x: 600, y: 300 } });
  await page.mouse.wheel(0, -1000);
  await expect.poll(async () => (await scene(operator)).reachM).toBeLessThan(reachM / 2);
  const zoomed = (await scene(operator)).reachM;
  await operator.expectFrames(10);
  expect((await scene(operator)).reachM).toBe(zoomed);
  await page.keyboard.press('c');
  await expect.poll(async () => Math.abs((await scene(operator)).reachM / reachM - 1)).toBeLessThan(0.31);
});

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
  await operator.look(testInfo, 'street');
  await page.keyboard.press('t');
  await operator.expectFrames(2);
  await operator.look(testInfo, 'street-above');
});

test('in a room whose floor is the robot’s own, grid and zoom are as usual', async ({ page, startStack }) => {
  const robot = { ...simulatedRobot, args: [...simulatedRobot.args, '--sim-lidars', '1'] };
  const stack = await startStack({ robots: [robot] });
  const operator = await OperatorPage.open(page, stack, { robot: robot.id });
  await operator.expectPoints(5000);
  await operator.expectFrames(60);
  expect(await scene(operator)).toEqual(USUAL);
});
