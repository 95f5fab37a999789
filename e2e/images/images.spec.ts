/** The documents' pictures of the page. Not tests: they write to docs/images. */
import { join } from 'node:path';
import { repositoryRoot } from '@farpoint/local-stack';
import type { Page } from '@playwright/test';
import { Headset } from '../src/headset.ts';
import { expectStanding, OperatorPage, poseOf } from '../src/operator-page.ts';
import { robotLike } from '../src/robots.ts';
import { expect, test } from '../src/smoke-test.ts';

const simulatedRobot = robotLike('sim-1');

/** Two eyes, or a dashboard, are more than the software renderer of a small machine draws beside the whole cloud. */
const SAMPLE = {
  ...simulatedRobot,
  args: ['--mode', 'points64', '--max-points', '40000', '--lambda', '0', '--fps', '10'],
};

const save = (page: Page, name: string) =>
  page.screenshot({ path: join(repositoryRoot, 'docs', 'images', `${name}.png`) });

/** Messages that come and go, such as that of the connection, have gone. */
async function expectQuiet(page: Page): Promise<void> {
  await expect(page.locator('#notice')).toBeHidden();
}

test('pictures', async ({ page, startStack }) => {
  await page.setViewportSize({ width: 960, height: 540 });
  const robot = {
    ...simulatedRobot,
    args: ['--sim-seed', '1', '--mode', 'points64', '--max-points', '15000', '--pictures-of-cloud'],
  };
  const stack = await startStack({ robots: [robot] });
  const operator = await OperatorPage.open(page, stack.webUrl, { robot: robot.id });
  await operator.expectPoints(10_000);
  await expect(page.locator('#pictures figure', { hasText: 'Camera' }).locator('canvas')).toBeVisible();
  await operator.expectFrames(30);
  await expectQuiet(page);
  await save(page, 'pictures');
});

test('headset-view', async ({ page, startStack }) => {
  await page.setViewportSize({ width: 960, height: 540 });
  const stack = await startStack({ robots: [SAMPLE] });
  await Headset.wear(page);
  const operator = await OperatorPage.open(page, stack.webUrl, { robot: SAMPLE.id });
  await operator.expectPoints(20_000);
  await page.getByRole('button', { name: /VR/ }).click();
  await operator.expectState('vr', true);
  await operator.expectPoints(20_000);
  await save(page, 'headset-view');
});

test('headset-tabletop', async ({ page, startStack }) => {
  await page.setViewportSize({ width: 960, height: 540 });
  const stack = await startStack({ robots: [SAMPLE] });
  const headset = await Headset.wear(page);
  const operator = await OperatorPage.open(page, stack.webUrl, { robot: SAMPLE.id });
  await operator.expectPoints(20_000);
  await page.getByRole('button', { name: /VR/ }).click();
  await operator.expectState('vr', true);
  await page.keyboard.press('KeyV');
  await page.keyboard.press('KeyV');
  // Two hands bring the model nearer and make it larger.
  await headset.place('left', [-0.1, 1.25, -0.5]);
  await headset.place('right', [0.1, 1.25, -0.5]);
  await headset.frames(3);
  await headset.button('left', 'trigger', 1);
  await headset.button('right', 'trigger', 1);
  await headset.frames(3);
  await headset.place('left', [-0.28, 1.4, -0.5]);
  await headset.place('right', [0.28, 1.4, -0.5]);
  await expect(page.locator('#notice')).toBeHidden();
  await operator.expectPoints(20_000);
  await save(page, 'headset-tabletop');
});

test('dashboard', async ({ page, startStack }) => {
  await page.setViewportSize({ width: 1280, height: 800 });
  const robot = { ...SAMPLE, args: [...SAMPLE.args, '--sim-charge', '19'] };
  const stack = await startStack({ robots: [robot] });
  const operator = await OperatorPage.open(page, stack.webUrl, { robot: robot.id });
  await operator.expectPoints(20_000);
  await page.keyboard.press('KeyB');
  const dashboard = page.locator('#dashboard');
  await expect(dashboard.locator('.state')).toHaveText(/^In step with the picture/);
  // A turn to the right, so that the map has a track and the curve of the speed a shape.
  const start = await poseOf(operator);
  await operator.hold(operator.script);
  await operator.expectMovedFrom(start, 0.5);
  await page.keyboard.down('d');
  await expect.poll(async () => Math.abs((await poseOf(operator)).yaw - start.yaw)).toBeGreaterThan(0.1);
  await page.keyboard.up('d');
  await operator.release();
  await expectStanding(operator);
  await operator.expectFrames(10);
  await expectQuiet(page);
  await save(page, 'dashboard');
});
