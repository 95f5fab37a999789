/** Several robots side by side: a page for each, one hand on one of them, and one STOP for all. */
import type { Page } from '@playwright/test';
import { expect, test } from '../src/stage/page-test.ts';
import type { Stage } from '../src/stage/stage.ts';

const cells = (page: Page) => page.locator('.cell');
const words = (page: Page, i: number) => cells(page).nth(i).getByRole('status');
const said = (page: Page) => page.locator('#said');
const frame = (page: Page, i: number) => page.frames().filter((each) => each !== page.mainFrame())[i]!;
const latched = (page: Page, i: number) =>
  frame(page, i).evaluate(() => window.farpointStage.robot.estop.latched);

async function openWall(stage: Stage): Promise<Page> {
  const page = await stage.openWall({
    robots: 'robot-1,robot-2',
    stage: 'live',
    canvas: '64x36',
    measure: '1',
  });
  for (const i of [0, 1]) await expect(words(page, i)).toHaveText('Live');
  return page;
}

test('one page has the keys, and the others do not drive', async ({ stage }) => {
  const page = await openWall(stage);
  await expect(page.locator('#keys')).toHaveText('Keys go to no robot: click one.');
  await frame(page, 0).locator('#stage').click();
  await stage.run(100);
  await page.keyboard.down('Space');
  await page.keyboard.down('KeyW');
  await stage.run(1000);
  await expect(page.locator('#keys')).toHaveText('Keys and controllers go to Robot on a stage.');
  await expect(words(page, 0)).toHaveText('You are driving.');
  await expect(words(page, 1)).toHaveText('Live');
  // The other page gets the hand: the first lets go, although nobody has lifted a key.
  await frame(page, 1).locator('#stage').click();
  await stage.run(1000);
  await expect(words(page, 0)).toHaveText('Live');
  for (const [width, height] of [
    [1280, 720],
    [3840, 2160],
    [360, 740],
    [667, 320],
    [640, 360],
    [320, 180],
  ] as const) {
    await stage.resize(width, height);
    await expect(page.getByRole('button', { name: 'STOP ALL' })).toBeInViewport({ ratio: 1 });
  }
});

test('STOP ALL stops both, and names a page that does not hear', async ({ stage }) => {
  const page = await openWall(stage);
  await page.getByRole('button', { name: 'STOP ALL' }).click();
  await stage.run(500);
  await expect(said(page)).toHaveText('STOP: 2 robots stopped.');
  for (const i of [0, 1]) {
    await expect(words(page, i)).toHaveText('Emergency stop is on.');
    expect(await latched(page, i)).toBe(true);
  }
  await page
    .locator('iframe')
    .nth(1)
    .evaluate((each: HTMLIFrameElement) => {
      each.src = 'about:blank';
    });
  await stage.run(2000);
  await expect(words(page, 1)).toHaveText('This page does not respond.');
  await page.getByRole('button', { name: 'STOP ALL' }).focus();
  await page.keyboard.press('KeyX');
  await stage.run(600);
  await expect(words(page, 1)).toHaveText('This page did not receive STOP: use the robot’s own stop.');
  await expect(said(page)).toHaveText('STOP: 1 of 2 pages did not receive it.');
});

test('a robot that does not confirm STOP is named', async ({ stage }) => {
  const page = await openWall(stage);
  await frame(page, 1).evaluate(() => {
    window.farpointStage.robot.obeys = false;
  });
  await page.getByRole('button', { name: 'STOP ALL' }).click();
  await stage.run(1500);
  await expect(said(page)).toHaveText('STOP: not confirmed by 1 robot.');
  await expect(words(page, 0)).toHaveText('Emergency stop is on.');
  await expect(words(page, 1)).toHaveText('The robot has not confirmed STOP.');
});
