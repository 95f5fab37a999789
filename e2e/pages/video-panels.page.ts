/** The cameras' panels on a flat screen: where they are, what fills the screen, and that neither is in the way of the hands. */
import type { Page } from '@playwright/test';
import { expectNothingCovered } from '../src/stage/boxes.ts';
import { expect, test } from '../src/stage/page-test.ts';
import type { Stage } from '../src/stage/stage.ts';
import { panelOf, videoOf } from '../src/stage/videos.ts';

const SCREEN = { width: 960, height: 540 };
const LARGE_SCREENS = [
  [1280, 720],
  [3840, 2160],
] as const;
const KEY_STEP = 24;
/** What may come first on a slow link, and the weights that the robot is then told. */
const CHOICES = [
  ['clouds first', 6, 1],
  ['cameras first', 1, 2],
  ['clouds and cameras alike', 2, 1],
] as const;

interface Box {
  x: number;
  y: number;
  width: number;
  height: number;
}

async function boxOf(page: Page, name: string): Promise<Box> {
  const box = await panelOf(page, name).boundingBox();
  if (box === null) throw new Error(`the panel of ${name} is not on the screen`);
  return box;
}

async function drag(page: Page, { x, y }: { x: number; y: number }, dx: number, dy: number): Promise<void> {
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + dx / 2, y + dy / 2);
  await page.mouse.move(x + dx, y + dy);
  await page.mouse.up();
}

async function dragTitle(page: Page, name: string, dx: number, dy: number): Promise<void> {
  const { x, y } = await boxOf(page, name);
  await drag(page, { x: x + 40, y: y + 10 }, dx, dy);
}

/** Opens the page, and waits for pictures of both cameras. */
async function open(stage: Stage, canvas = '64x36'): Promise<Page> {
  const page = await stage.open({ state: 'videos', canvas });
  await stage.run(500);
  return page;
}

/** Drives ahead for a while. @returns how far the robot came, metres */
async function driveAhead(stage: Stage): Promise<number> {
  const { page } = stage;
  const from = (await stage.state()).body?.x ?? Number.NaN;
  for (const key of ['Space', 'ArrowUp']) await page.keyboard.down(key);
  await stage.run(1000);
  for (const key of ['ArrowUp', 'Space']) await page.keyboard.up(key);
  await stage.run(300);
  return ((await stage.state()).body?.x ?? Number.NaN) - from;
}

test('panels are moved by hand and by keys, keep their shape and their place, and cover no control', async ({
  stage,
}) => {
  const page = await open(stage);
  const panel = (name: string) => panelOf(page, name);
  await expectNothingCovered(page, 'in their usual places');
  const docked = await boxOf(page, 'Front');

  await dragTitle(page, 'Front', -400, 20);
  const dragged = await boxOf(page, 'Front');
  expect([dragged.x - docked.x, dragged.y - docked.y].map(Math.round)).toEqual([-400, 20]);
  expect(dragged.width).toBeCloseTo(docked.width, 0);
  // Beyond the corner of the screen, where the emergency stop is.
  await dragTitle(page, 'Rear', 2000, 2000);
  await expectNothingCovered(page, 'moved into a corner', true);

  await panel('Front').focus();
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('ArrowDown');
  const stepped = await boxOf(page, 'Front');
  expect([stepped.x - dragged.x, stepped.y - dragged.y].map(Math.round)).toEqual([-2 * KEY_STEP, KEY_STEP]);
  const shape = async () => {
    const { width, height } = (await panel('Front').locator('canvas').boundingBox()) ?? {
      width: 0,
      height: 0,
    };
    return width / height;
  };
  // The corner may be below what the page has just said.
  await stage.run(10_000);
  await expect(page.locator('#notice')).toBeHidden();
  await drag(page, { x: stepped.x + stepped.width - 4, y: stepped.y + stepped.height - 4 }, -60, 0);
  const smaller = await boxOf(page, 'Front');
  expect(smaller.width).toBeCloseTo(stepped.width - 60, 0);
  expect(await shape()).toBeCloseTo(4 / 3, 1);
  await panel('Front').focus();
  await page.keyboard.press('+');
  expect((await boxOf(page, 'Front')).width).toBeCloseTo(smaller.width + KEY_STEP, 0);
  await page.keyboard.press('-');
  expect((await boxOf(page, 'Front')).width).toBeCloseTo(smaller.width, 0);

  // With the grip held, the same keys drive.
  const before = await boxOf(page, 'Front');
  expect(await driveAhead(stage)).toBeGreaterThan(0.3);
  expect(await boxOf(page, 'Front')).toEqual(before);

  const placed = await boxOf(page, 'Front');
  await stage.resize(700, 480);
  for (const name of ['Front', 'Rear']) {
    const { x, y, width, height } = await boxOf(page, name);
    expect([x >= 0, y >= 0, x + width <= 700, y + height <= 480], name).toEqual([true, true, true, true]);
  }
  await expectNothingCovered(page, 'in a smaller window', true);
  await stage.resize(SCREEN.width, SCREEN.height);
  expect(await boxOf(page, 'Front')).toEqual(placed);

  // The one that was touched last is on top.
  const rear = await boxOf(page, 'Rear');
  await dragTitle(page, 'Rear', before.x - rear.x + 30, before.y - rear.y + 30);
  const top = ({ x, y, width }: Box) =>
    page.evaluate(([x, y]) => document.elementFromPoint(x, y)?.closest('figure')?.ariaLabel, [
      x + width - 10,
      y + 45,
    ] as const);
  expect(await top(before)).toBe('Rear');
  await panel('Front').click({ position: { x: 10, y: 10 } });
  expect(await top(before)).toBe('Front');

  const kept = await boxOf(page, 'Front');
  // The browser keeps it.
  await stage.reload();
  await stage.run(800);
  expect(await boxOf(page, 'Front')).toEqual(kept);
  await page.getByRole('button', { name: 'Reset panels' }).click();
  expect(await boxOf(page, 'Front')).toEqual(docked);
  await expect(page.getByRole('button', { name: 'Reset panels' })).toBeHidden();
});

test('one key lets a camera fill the screen and puts the cloud into its panel; driving and stopping go on', async ({
  stage,
}) => {
  const page = await open(stage, 'full');
  const label = page.locator('#camera-stage p');
  await page.keyboard.press('KeyF');
  const filling = page.locator('#camera-stage canvas');
  expect(await filling.boundingBox()).toEqual({ x: 0, y: 0, ...SCREEN });
  await stage.run(300);
  await expect(label).toHaveText(/^Front · \d+ ms$/);
  const cloud = await panelOf(page, 'Front').locator('#stage').boundingBox();
  expect(cloud?.width).toBeLessThan(320);
  expect((cloud?.width ?? 0) / (cloud?.height ?? 0)).toBeCloseTo(4 / 3, 1);
  await expect(panelOf(page, 'Front').locator('figcaption')).toHaveText(/^Cloud/);
  // Both are drawn on, each with every frame that comes, and the cloud no larger than its panel.
  const drawn = async () => {
    const [{ framesDrawn }, { frames }] = [await stage.stats(), await videoOf(stage, 'Front')];
    return { framesDrawn, frames };
  };
  // What comes by itself would count or not by where the display's frames lie.
  await stage.script((robot) => {
    robot.stream(null);
    robot.play(null);
  });
  await stage.run(300);
  const before = await drawn();
  for (let sent = 1; sent <= 5; sent++) {
    await stage.script((robot) => {
      robot.cloud('light', { ageMs: 50 });
      robot.video('Front', { ageMs: 50 });
    });
    await stage.run(150);
    expect(await drawn()).toEqual({ framesDrawn: before.framesDrawn + sent, frames: before.frames + sent });
  }
  await stage.script((robot) => {
    robot.stream('light');
    robot.play({ Front: {}, Rear: {} });
  });
  await stage.run(300);
  const { canvas } = await stage.stats();
  expect(canvas.width).toBeLessThanOrEqual(cloud?.width ?? 0);
  expect(canvas.width / canvas.height).toBeCloseTo(4 / 3, 1);
  await expectNothingCovered(page, 'a camera fills the screen', true);

  expect(await driveAhead(stage)).toBeGreaterThan(0.3);
  await page.getByRole('button', { name: 'STOP' }).click();
  expect((await stage.state()).estop).toBe(true);
  await stage.run(300);
  await expectNothingCovered(page, 'a camera fills the screen, stopped', true);
  expect(await driveAhead(stage)).toBe(0);

  // The other camera, by its button; then the cloud again.
  await page.getByRole('button', { name: 'Fill the screen with Rear' }).click();
  await expect(label).toHaveText(/^Rear · \d+ ms$/);
  await expect(panelOf(page, 'Rear').locator('#stage')).toBeVisible();
  await expect(panelOf(page, 'Front').locator('canvas:not(#stage)')).toBeVisible();
  await page.keyboard.press('KeyF');
  await expect(page.locator('#camera-stage')).toBeHidden();
  expect(await page.locator('#stage').boundingBox()).toEqual({ x: 0, y: 0, ...SCREEN });
  await stage.run(300);
  const whole = (await stage.stats()).canvas;
  expect(whole.width / whole.height).toBeCloseTo(SCREEN.width / SCREEN.height, 1);

  // A camera that is switched off does not leave a black screen.
  await page.keyboard.press('KeyF');
  await expect(page.locator('#camera-stage')).toBeVisible();
  await page.getByRole('button', { name: 'Hide Front' }).click();
  await expect(page.locator('#camera-stage')).toBeHidden();
  await expect(page.locator('main > #stage')).toBeVisible();
});

/** Opens what became of the frames, and chooses what comes first: all of it is legible, and the robot is told. */
async function expectChoice(stage: Stage, screen: string): Promise<void> {
  const { page } = stage;
  const report = page.locator('.video-report > button');
  if ((await report.getAttribute('aria-expanded')) !== 'true') await report.click();
  const choice = page.getByLabel('What comes first on a slow link');
  const words = page.locator('.link-share > span');
  for (const [option, cloud, video] of CHOICES) {
    await choice.selectOption(option);
    await stage.run(300);
    const told = (await stage.sent('shares')).at(-1);
    expect(told, option).toEqual({ type: 'shares', cloud, videos: [video, video] });
    await expect(choice, screen).toBeInViewport({ ratio: 1 });
    const cut = await choice.evaluate((select) => select.scrollWidth - select.clientWidth);
    expect(cut, `${option} on ${screen}`).toBeLessThanOrEqual(0);
  }
  const [of, box] = [await words.boundingBox(), await choice.boundingBox()];
  expect((of?.x ?? Number.NaN) + (of?.width ?? Number.NaN), screen).toBeLessThanOrEqual(box?.x ?? Number.NaN);
  await expectNothingCovered(page, screen, true);
}

test('what comes first on a slow link is chosen below the panels, on a laptop and on a large screen', async ({
  stage,
}) => {
  await open(stage);
  for (const [width, height] of LARGE_SCREENS) {
    await stage.resize(width, height);
    await expectChoice(stage, `${width} × ${height}`);
  }
});

test.describe('on a phone', () => {
  test.use({ viewport: { width: 360, height: 740 }, hasTouch: true });

  test('the panels stay in their strip and cover nothing; a camera can fill the screen', async ({
    stage,
  }) => {
    const { page } = stage;
    await page.addInitScript(() =>
      localStorage.setItem('farpoint.panels', '{"panels":[{"name":"video:Front","x":1,"y":1,"width":300}]}'),
    );
    await open(stage);
    // What it says on connecting is only read, and lies over the pictures for some seconds.
    await stage.run(6000);
    await expect(panelOf(page, 'Front').locator('canvas')).toBeVisible();
    await expect(panelOf(page, 'Front')).toHaveAttribute('data-floating', 'false');
    await expect(page.getByRole('button', { name: 'Reset panels' })).toBeHidden();
    await expectNothingCovered(page, 'panels on a phone');
    await page.getByRole('button', { name: 'Fill the screen with Rear' }).tap();
    await expect(page.locator('#camera-stage p')).toHaveText(/^Rear · \d+ ms$/);
    expect(await page.locator('#camera-stage canvas').boundingBox()).toEqual({
      x: 0,
      y: 0,
      width: 360,
      height: 740,
    });
    await expectNothingCovered(page, 'a camera fills a phone', true);
    await page.locator('#estop').click({ trial: true });
    await page.getByRole('button', { name: 'Fill the screen with the cloud' }).tap();
    await expect(page.locator('#camera-stage')).toBeHidden();
    await expectChoice(stage, 'a phone');
  });
});
