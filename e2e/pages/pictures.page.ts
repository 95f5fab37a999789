/** Single pictures of the robot's cameras: asked for while their panels are shown, drawn to the pixel, and never old unmarked. */
import type { Page } from '@playwright/test';
import { headsetViewport } from '../src/headset.ts';
import { expectNothingCovered } from '../src/stage/boxes.ts';
import { barsPicture } from '../src/stage/camera-pictures.ts';
import { enterVr } from '../src/stage/in-headset.ts';
import { expect, test } from '../src/stage/page-test.ts';
import { FRAME_MS, type Rgb, type Stage } from '../src/stage/stage.ts';

const RED: Rgb = [255, 0, 0];
const BLUE: Rgb = [0, 0, 255];
const BARS: readonly Rgb[] = [RED, [0, 255, 0], BLUE, [255, 255, 255]];
const bars = await barsPicture(640, 480, BARS);
const reversed = await barsPicture(640, 480, BARS.toReversed());

const panel = (page: Page, name: string) =>
  page.locator('#pictures').getByRole('figure', { name, exact: true });

/** Colours in the middle of each bar of a panel. */
const shown = (page: Page, name: string) =>
  panel(page, name)
    .locator('canvas')
    .evaluate((canvas: HTMLCanvasElement, count) => {
      const context = canvas.getContext('2d');
      return Array.from({ length: count }, (_, i) => {
        const x = Math.floor(((i + 0.5) * canvas.width) / count);
        return [...(context?.getImageData(x, canvas.height >> 1, 1, 1).data.slice(0, 3) ?? [])];
      });
    }, BARS.length);

const camera = (page: Page, name: string) =>
  page.evaluate((name) => window.farpoint.cameras().find((each) => each.name === name), name);

async function expectBars(page: Page, name: string, colours: readonly Rgb[]): Promise<void> {
  const away = (await shown(page, name)).map((seen, i) =>
    Math.max(...seen.map((level, c) => Math.abs(level - (colours[i]?.[c] ?? Number.NaN)))),
  );
  // A JPEG's colours are a level or two off.
  expect(Math.max(...away), `${name}: ${away}`).toBeLessThan(4);
}

const asked = async (stage: Stage) => (await stage.sent('pictures')).at(-1)?.cameras;

test('pictures are asked for and drawn, one after the other; without new ones they are frozen; a broken one changes nothing', async ({
  stage,
}) => {
  const page = await stage.open({ state: 'cameras' });
  expect(await asked(stage)).toEqual([0, 1]);
  const [gripper, mast] = [panel(page, 'Gripper'), panel(page, 'Mast')];
  for (const each of [gripper, mast]) {
    await expect(each).toHaveAttribute('data-state', 'waiting');
    await expect(each.locator('.age')).toHaveText('waiting');
    await expect(each.locator('canvas')).toBeHidden();
  }

  await stage.picture(0, bars);
  await stage.run(300);
  await expect(gripper).toHaveAttribute('data-state', 'live');
  await expect(gripper.locator('canvas')).toBeVisible();
  await expectBars(page, 'Gripper', BARS);
  expect(await camera(page, 'Gripper')).toMatchObject({
    ...{ width: 640, height: 480, pictures: 1, failures: 0 },
  });
  // Its age counts from when it was taken.
  await stage.picture(0, reversed, 280);
  await expectBars(page, 'Gripper', BARS.toReversed());
  expect(await camera(page, 'Gripper')).toMatchObject({ pictures: 2, failures: 0 });
  // The other camera is silent.
  await expect(mast).toHaveAttribute('data-state', 'waiting');

  await stage.run(600);
  await expect(gripper.locator('.age')).toHaveText('880 ms');
  await stage.run(300);
  await expect(gripper).toHaveAttribute('data-state', 'frozen');
  await expect(gripper.locator('.age')).toHaveText('frozen, 1.1 s');

  // The robot says another size than its file; a file ends in its middle; one is none.
  const half = Buffer.from(bars.base64, 'base64').subarray(0, 200).toString('base64');
  for (const broken of [
    { ...bars, width: 1280 },
    { ...bars, base64: half },
    { ...bars, base64: Buffer.from('no picture').toString('base64') },
  ])
    for (const each of [0, 1]) await stage.picture(each, broken);
  await stage.run(400);
  await expect(gripper).toHaveAttribute('data-state', 'frozen');
  await expectBars(page, 'Gripper', BARS.toReversed());
  await expect(mast.locator('.age')).toHaveText('waiting');
  expect(await camera(page, 'Gripper')).toMatchObject({ pictures: 2, failures: 3 });
  expect(await camera(page, 'Mast')).toMatchObject({ pictures: 0, failures: 3 });
  await stage.picture(0, bars);
  await stage.run(400);
  await expect(gripper).toHaveAttribute('data-state', 'live');
  await expectBars(page, 'Gripper', BARS);
});

test('a hidden picture is not asked for, and not shown if it comes', async ({ stage }) => {
  const page = await stage.open({ state: 'cameras' });
  const gripper = panel(page, 'Gripper');
  await stage.picture(0, bars);
  await page.getByRole('button', { name: 'Hide Gripper' }).click();
  await stage.run(400);
  await expect(gripper.locator('canvas')).toBeHidden();
  await expect(gripper.locator('.age')).toHaveText('hidden');
  expect(await asked(stage)).toEqual([1]);
  // One that was on its way.
  await stage.picture(0, reversed);
  await stage.run(400);
  expect(await camera(page, 'Gripper')).toMatchObject({ shown: false, pictures: 1 });
  await page.getByRole('button', { name: 'Show Gripper' }).click();
  await stage.run(400);
  expect(await asked(stage)).toEqual([0, 1]);
  await stage.picture(0, reversed);
  await stage.run(400);
  await expect(gripper).toHaveAttribute('data-state', 'live');
  await expectBars(page, 'Gripper', BARS.toReversed());
});

test.describe('on a phone held upright', () => {
  test.use({ viewport: { width: 390, height: 844 }, hasTouch: true });

  test('pictures are on the screen, large enough to see something, and cover no control', async ({
    stage,
  }) => {
    const page = await stage.open({ state: 'cameras', canvas: '64x36' });
    for (const each of [0, 1]) await stage.picture(each, bars);
    await stage.run(400);
    expect(await expectNothingCovered(page, 'two pictures')).toEqual(
      expect.arrayContaining(['estop', 'joystick', 'facts-fold', 'pictures']),
    );
    for (const name of ['Gripper', 'Mast']) {
      const box = await panel(page, name).boundingBox();
      expect(box?.width).toBeGreaterThan(120);
    }
    await page.getByRole('button', { name: 'Hide Gripper' }).tap();
    await stage.run(400);
    await expect(panel(page, 'Gripper').locator('canvas')).toBeHidden();
    await expect(panel(page, 'Mast').locator('canvas')).toBeVisible();
  });
});

test.describe('in the headset', () => {
  test.use({ viewport: headsetViewport });

  test('a picture is beside the panel on the wrist until it is hidden; then the next one is', async ({
    stage,
  }) => {
    const headset = await enterVr(stage, { state: 'cameras', canvas: '320x180', frameMs: FRAME_MS });
    const { page } = stage;
    // Upwards, where there is nothing behind it.
    await headset.place('left', [-0.12, 1.92, -0.45]);
    await stage.picture(0, await barsPicture(320, 240, [RED]));
    await stage.picture(1, await barsPicture(320, 240, [BLUE]));
    await stage.frames(20);
    const seen = async (colour: Rgb) => {
      const eyes = [];
      for (const x of [0, 0.5]) eyes.push(await stage.share(colour, { x, y: 0, width: 0.5, height: 1 }, 30));
      return Math.min(...eyes);
    };
    const hide = async (name: string) => {
      // The emulated headset's picture lies over the page.
      await page.getByRole('button', { name: `Hide ${name}` }).dispatchEvent('click');
      await stage.frames(20);
    };
    expect(await seen(RED)).toBeGreaterThan(0.04);
    expect(await seen(BLUE)).toBe(0);
    await hide('Gripper');
    expect(await seen(RED)).toBe(0);
    expect(await seen(BLUE)).toBeGreaterThan(0.04);
    await hide('Mast');
    expect(await seen(BLUE)).toBe(0);
  });
});
