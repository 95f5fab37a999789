import { readFileSync } from 'node:fs';
import type { Page } from '@playwright/test';
import { expectOnScreenAndApart } from '../src/layout.ts';
import { OperatorPage, screenSizes } from '../src/operator-page.ts';
import { type Part, type Rgb, sharesNear } from '../src/picture.ts';
import { expect, LONG, test } from '../src/stack-test.ts';

const BACKGROUND: Rgb = [11, 15, 20];
/** Behind the robot, when it is seen from above; and the floor before the operator. */
const BEHIND: Part = { left: 0.42, top: 0.7, width: 0.16, height: 0.12 };
const FLOOR: Part = { left: 0.35, top: 0.67, width: 0.3, height: 0.12 };

const robot = {
  id: 'memory',
  name: 'Memory',
  args: [
    ...['--source', 'sim', '--sim-seed', '1', '--sim-size', '320', '--fps', '5'],
    ...['--start-mbps', '20', '--bitrate-mbps', '30'],
  ],
};

/** Most of the grid of the ground is nearer to the background than this; points seldom are. */
const GRID_CONTRAST = 16;

/** Share of a part of the page where points are drawn. */
async function drawnShare(page: Page, part: Part): Promise<number> {
  const [empty] = await sharesNear(page, await page.screenshot(), part, [BACKGROUND], GRID_CONTRAST);
  return 1 - (empty as number);
}

// A robot of whole clouds, driven about: minutes on two slow cores.
test.setTimeout(240_000);

/** Turns the robot in place until it looks away from where it looked. */
async function turnRound(operator: OperatorPage, page: Page): Promise<void> {
  const { yaw } = await operator.body();
  const turned = async () => {
    await page.evaluate(() => window.farpoint.drive({ forward: 0, left: 1 }, 400));
    const now = (await operator.body()).yaw;
    return Math.abs(Math.atan2(Math.sin(now - yaw), Math.cos(now - yaw)));
  };
  await expect
    .poll(turned, { message: 'radians turned', intervals: [10], timeout: 60_000 })
    .toBeGreaterThan(2.5);
}

/** Looks to the right by dragging, as far as the robot turns to the left. */
async function lookBack(page: Page): Promise<void> {
  for (let i = 0; i < 2; i++) {
    await page.mouse.move(900, 250);
    await page.mouse.down();
    await page.mouse.move(330, 250, { steps: 5 });
    await page.mouse.up();
  }
}

/** Share of a half of the small map where something is remembered, 0–1. */
async function mapped(page: Page, half: 'ahead' | 'behind'): Promise<number> {
  return await page.locator('#minimap-picture').evaluate((canvas, half) => {
    if (!(canvas instanceof HTMLCanvasElement)) return Number.NaN;
    const { width, height } = canvas;
    const context = canvas.getContext('2d');
    const data = context?.getImageData(0, half === 'ahead' ? 0 : height / 2, width, height / 2).data ?? [];
    let seen = 0;
    for (let i = 3; i < data.length; i += 4) seen += Number(data[i] === 255);
    return seen / (data.length / 4);
  }, half);
}

test(
  'a small map shows what is remembered around the robot and the way driven, and covers nothing',
  { tag: LONG },
  async ({ page, startStack }, testInfo) => {
    await page.setViewportSize({ width: 1280, height: 720 });
    const stack = await startStack({ robots: [robot] });
    const open = { robot: robot.id, canvas: '320x180', every: '2', memory: '1' } as const;
    const operator = await OperatorPage.open(page, stack, open);
    await operator.expectPoints(10_000);
    const map = page.locator('#minimap');
    await expect
      .poll(() => mapped(page, 'ahead'), { message: 'share of the map ahead' })
      .toBeGreaterThan(0.15);
    await expect(page.locator('#minimap-age')).toHaveText(/^up to \d+ s old$/);
    expect(await mapped(page, 'behind')).toBeLessThan(0.1);
    const start = await operator.body();
    const driven = async () => {
      await page.evaluate(() => window.farpoint.drive({ forward: 0.5, left: 0 }, 300));
      const { x, y } = await operator.body();
      return Math.hypot(x - start.x, y - start.y);
    };
    await expect
      .poll(driven, { message: 'metres driven', intervals: [10], timeout: 60_000 })
      .toBeGreaterThan(0.4);
    await turnRound(operator, page);
    await expect.poll(() => mapped(page, 'behind'), { message: 'share behind' }).toBeGreaterThan(0.15);
    await map.screenshot({ path: testInfo.outputPath('map.png') });

    const pieces = page.locator(
      '#bar button:visible, #drive button:visible, #facts, #clouds .heads button, #near:visible, #minimap:visible',
    );
    for (const size of screenSizes) {
      await page.setViewportSize(size);
      await expect(map).toBeVisible({ visible: size.width > 1100 });
      await operator.expectFrames(3);
      await operator.look(testInfo, `map-${size.width}`);
      await expectOnScreenAndApart(pieces, size);
    }
    await page.setViewportSize({ width: 1280, height: 720 });
    await expect(map).toBeVisible();
    await page.getByRole('button', { name: 'Colours', exact: true }).click();
    await page.getByRole('button', { name: 'Memory', exact: true }).click();
    await expect(map).toBeHidden();
  },
);

test(
  'what was seen stays behind the robot, can be saved and loaded, and is forgotten on reload',
  { tag: LONG },
  async ({ page, startStack }, testInfo) => {
    const stack = await startStack({ robots: [robot] });
    const open = { robot: robot.id, canvas: '320x180', every: '2', memory: '1' } as const;
    const operator = await OperatorPage.open(page, stack, open);
    await operator.expectPoints(10_000);
    const rememberedPoints = async () => (await operator.stats()).remembered?.points ?? 0;
    await expect.poll(rememberedPoints, { message: 'remembered points in view' }).toBeGreaterThan(3000);
    await expect(page.locator('#facts')).toContainText(/Remembered\s*up to \d+ s old/);

    await turnRound(operator, page);
    await operator.expectFrames(5);
    await lookBack(page);
    await operator.look(testInfo, 'looking-back');
    expect(await drawnShare(page, FLOOR)).toBeGreaterThan(0.6);
    await page.keyboard.press('t');
    await operator.look(testInfo, 'from-above');
    const above = await drawnShare(page, BEHIND);
    expect(above).toBeGreaterThan(0.25);

    await page.getByRole('button', { name: 'Colours', exact: true }).click();
    const memory = page.getByRole('button', { name: 'Memory', exact: true });
    await expect(memory).toHaveAttribute('aria-pressed', 'true');
    await operator.look(testInfo, 'panel');
    const downloading = page.waitForEvent('download');
    await page.getByRole('button', { name: 'Save', exact: true }).click();
    const file = testInfo.outputPath('remembered.ply');
    await (await downloading).saveAs(file);
    expect(readFileSync(file).subarray(0, 200).toString('latin1')).toMatch(
      /^ply\nformat binary_little_endian 1\.0\n/,
    );
    const text = testInfo.outputPath('remembered.pcd');
    await page.getByLabel('Format of the file').selectOption('pcd-text');
    const downloadingText = page.waitForEvent('download');
    await page.getByRole('button', { name: 'Save', exact: true }).click();
    expect((await downloadingText).suggestedFilename()).toMatch(/\.pcd$/);
    await (await downloadingText).saveAs(text);
    expect(readFileSync(text).subarray(0, 400).toString('latin1')).toMatch(
      /^# \.PCD v0\.7[\s\S]*\nDATA ascii\n/,
    );
    await memory.click();
    await expect
      .poll(() => drawnShare(page, BEHIND), { message: 'drawn without memory' })
      .toBeLessThan(above / 4);
    await memory.click();
    await expect.poll(() => drawnShare(page, BEHIND), { message: 'drawn again' }).toBeGreaterThan(above / 2);

    await operator.reload();
    await operator.expectPoints(10_000);
    await page.keyboard.press('t');
    await operator.expectFrames(5);
    expect(await drawnShare(page, BEHIND)).toBeLessThan(above / 4);
    await page.getByLabel('Point cloud to remember').setInputFiles(file);
    await expect
      .poll(() => drawnShare(page, BEHIND), { message: 'drawn from the file' })
      .toBeGreaterThan(above / 2);
    await operator.look(testInfo, 'loaded');
    await page.getByRole('button', { name: 'Colours', exact: true }).click();
    await page.getByRole('button', { name: 'Forget', exact: true }).click();
    await expect
      .poll(() => drawnShare(page, BEHIND), { message: 'drawn when forgotten' })
      .toBeLessThan(above / 4);
    await page.getByLabel('Point cloud to remember').setInputFiles(text);
    await expect
      .poll(() => drawnShare(page, BEHIND), { message: 'drawn from text' })
      .toBeGreaterThan(above / 2);
    await page.getByLabel('Point cloud to remember').setInputFiles({
      ...{ name: 'not.ply', mimeType: 'application/octet-stream', buffer: Buffer.from('pcd') },
    });
    await expect.poll(async () => (await operator.state()).notice).toContain('not.ply cannot be loaded');
  },
);
