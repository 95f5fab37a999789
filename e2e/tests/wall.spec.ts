/** Several robots side by side: a page for each, one hand on one of them, and one STOP for all. */
import type { Frame, Page } from '@playwright/test';
import { expectAccessible } from '../src/accessibility.ts';
import { expectOnScreenAndApart } from '../src/layout.ts';
import { OperatorPage, screenSizes } from '../src/operator-page.ts';
import { expect, test, twoRobots } from '../src/stack-test.ts';

const IDS = twoRobots.map(({ id }) => id);
const NAMES = twoRobots.map(({ name }) => name);

/** The page in the wall that shows this robot. */
function frameOf(page: Page, robot: string): Frame {
  const frame = page.frames().find((each) => each.url().includes(`robot=${robot}`));
  if (frame === undefined) throw new Error(`no frame shows ${robot}`);
  return frame;
}

const latched = (page: Page, robot: string) =>
  frameOf(page, robot).evaluate(() => window.farpoint.state().estop);

test('one robot is driven and the other stands', async ({ page, startStack }, testInfo) => {
  const stack = await startStack({ robots: twoRobots });
  // The way there begins at the list.
  await OperatorPage.open(page, stack, { canvas: '64x36' });
  await page.getByRole('link', { name: 'Side by side' }).click();
  await page.waitForURL(/wall\.html\?.*robots=sim-1,sim-2$/);
  const cells = page.locator('.cell');
  const words = (i: number) => cells.nth(i).getByRole('status');
  for (const i of [0, 1]) await expect(words(i)).toHaveText('Live.', { timeout: 30_000 });
  await expect(cells.getByRole('heading')).toHaveText(NAMES);
  await expect(page.locator('#keys')).toHaveText('Keys go to no robot: click on one.');

  await frameOf(page, IDS[0]!).locator('#stage').click();
  await expect(page.locator('#keys')).toHaveText(`Keys and controllers go to ${NAMES[0]}.`);
  // Two pages on a busy computer: a grip that is not read in time is let go, and held again.
  await expect(async () => {
    await page.keyboard.up('Space');
    await page.keyboard.down('Space');
    await expect(words(0)).toHaveText('You drive.', { timeout: 3000 });
  }).toPass();
  await expect(words(1)).toHaveText('Live.');
  await page.keyboard.up('Space');
  await expect(words(0)).toHaveText('Live.');

  for (const size of screenSizes) {
    await page.setViewportSize(size);
    await page.screenshot({ path: testInfo.outputPath(`wall-${size.width}.png`) });
    await expectOnScreenAndApart(page.locator('#bar > *'), size);
  }
  await page.setViewportSize({ width: 1280, height: 720 });
  await expectAccessible(page, 'wall', 'iframe');
});

test('STOP ALL stops both, and names a page that does not hear', async ({ page, startStack }) => {
  const stack = await startStack({ robots: twoRobots });
  await page.goto(new URL(`wall.html?canvas=64x36&robots=${IDS.join()}`, stack.webUrl).href);
  const cells = page.locator('.cell');
  const words = (i: number) => cells.nth(i).getByRole('status');
  for (const i of [0, 1]) await expect(words(i)).toHaveText('Live.', { timeout: 30_000 });

  await page.getByRole('button', { name: 'STOP ALL' }).press('Enter');
  await expect(page.getByRole('alert').first()).toHaveText('STOP: 2 robots stopped.');
  for (const [i, id] of IDS.entries()) {
    await expect(words(i)).toHaveText('Emergency stop is on.');
    expect(await latched(page, id)).toBe(true);
  }

  // A page that is no longer there.
  await cells
    .nth(1)
    .locator('iframe')
    .evaluate((frame: HTMLIFrameElement) => {
      frame.src = 'about:blank';
    });
  await expect(words(1)).toHaveText('This page does not answer.');
  await page.keyboard.press('KeyX');
  await expect(words(1)).toHaveText('This page did not hear STOP: use the robot’s own stop.');
  await expect(page.getByRole('alert').first()).toHaveText('STOP: 1 of 2 pages did not hear it.');

  await cells
    .nth(1)
    .getByRole('button', { name: /^Close/ })
    .click();
  await expect(cells).toHaveCount(1);
  await page.getByRole('button', { name: 'Add a robot' }).click();
  await expect(words(1)).toHaveText('No robot is chosen.');
  await cells.nth(1).locator('iframe').contentFrame().getByRole('button', { name: NAMES[1]! }).click();
  await expect(words(1)).toHaveText('Emergency stop is on.', { timeout: 30_000 });
  // Whoever loads it again has the same robots.
  await page.reload();
  await expect(words(1)).toHaveText('Emergency stop is on.', { timeout: 30_000 });
  await expect(cells.getByRole('heading')).toHaveText(NAMES);
});
