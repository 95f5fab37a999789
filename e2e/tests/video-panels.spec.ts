/** The cameras' panels on a flat screen: where they are, what fills the screen, and what they say. */
import type { Page } from '@playwright/test';
import { expectNothingCovered } from '../src/nothing-covered.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';
import { hasVideo, type TestCamera, testCamera, videoRobot } from '../src/video-robot.ts';

test.skip(!hasVideo, 'needs GStreamer and `pnpm build:native video`');

const panel = (page: Page, name: string) => page.locator(`#pictures figure[aria-label="${name}"]`);
const boxOf = async (page: Page, name: string) => (await panel(page, name).boundingBox())!;
const stateOf = (page: Page, name: string) => panel(page, name).getAttribute('data-state');
const videos = (page: Page) => page.evaluate(() => window.farpoint.videos());
const small = { width: 320, height: 240, framesPerS: 15, kbitPerS: 400 };
const camera = (name: string, pattern: string, more: Partial<TestCamera> = {}) =>
  testCamera(name, 'vp8enc', {
    ...{ source: { kind: 'test', pattern, width: 320, height: 240, framesPerS: 15 }, ...small },
    ...more,
  });
const twoCameras = [camera('Front', 'pinwheel'), camera('Rear', 'ball')];

async function drag(page: Page, from: { x: number; y: number }, dx: number, dy: number): Promise<void> {
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x + dx / 2, from.y + dy / 2);
  await page.mouse.move(from.x + dx, from.y + dy);
  await page.mouse.up();
}

async function dragTitle(page: Page, name: string, dx: number, dy: number): Promise<void> {
  const { x, y } = await boxOf(page, name);
  await drag(page, { x: x + 40, y: y + 10 }, dx, dy);
}

async function open(
  page: Page,
  startStack: Parameters<Parameters<typeof test>[2]>[0]['startStack'],
  cameras = twoCameras,
) {
  const stack = await startStack({ robots: [videoRobot(lightRobot, cameras)] });
  const operator = await OperatorPage.open(page, stack, { robot: lightRobot.id });
  await operator.expectPoints(300);
  return { stack, operator };
}

test('panels are moved by hand and by keys, keep their shape and their place, and cover no control', async ({
  page,
  startStack,
}, testInfo) => {
  const { operator } = await open(page, startStack);
  for (const { name } of twoCameras) await expect(panel(page, name).locator('canvas')).toBeVisible();
  await expectNothingCovered(page);
  const docked = await boxOf(page, 'Front');

  await dragTitle(page, 'Front', -400, 20);
  const dragged = await boxOf(page, 'Front');
  expect(dragged.x).toBeCloseTo(docked.x - 400, 0);
  expect(dragged.y).toBeCloseTo(docked.y + 20, 0);
  expect(dragged.width).toBeCloseTo(docked.width, 0);

  // Beyond the screen's corner, where the emergency stop is.
  await dragTitle(page, 'Rear', 2000, 2000);
  await expectNothingCovered(page);
  await operator.look(testInfo, 'moved');

  await panel(page, 'Front').focus();
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('ArrowLeft');
  const stepped = await boxOf(page, 'Front');
  expect([dragged.x - stepped.x, dragged.y - stepped.y].map(Math.round)).toEqual([48, 0]);
  const aspectOf = async () => {
    const { width, height } = (await panel(page, 'Front').locator('canvas').boundingBox())!;
    return width / height;
  };
  // The corner may be below what the page has just said.
  await expect(page.locator('#notice')).toBeHidden();
  await drag(page, { x: stepped.x + stepped.width - 4, y: stepped.y + stepped.height - 4 }, -60, 0);
  const smaller = await boxOf(page, 'Front');
  expect(smaller.width).toBeCloseTo(stepped.width - 60, 0);
  expect(await aspectOf()).toBeCloseTo(4 / 3, 1);
  await panel(page, 'Front').focus();
  await page.keyboard.press('+');
  expect((await boxOf(page, 'Front')).width).toBeCloseTo(smaller.width + 24, 0);

  // With the grip held, the same keys drive.
  const before = await boxOf(page, 'Front');
  const start = await operator.body();
  const keys = ['Space', 'ArrowUp'];
  await operator.hold({
    hold: async () => {
      for (const key of keys) await page.keyboard.down(key);
    },
    release: async () => {
      for (const key of keys.toReversed()) await page.keyboard.up(key);
    },
  });
  await operator.expectMovedFrom(start, 0.2);
  await operator.release();
  // A key that moves a panel moves it by 24 pixels; what it keeps clear of may move it by one.
  const after = await boxOf(page, 'Front');
  expect({ ...after, y: before.y }).toEqual(before);
  expect(Math.abs(after.y - before.y)).toBeLessThan(3);

  // The one that was touched last is on top.
  await dragTitle(
    page,
    'Rear',
    before.x - (await boxOf(page, 'Rear')).x + 30,
    before.y - (await boxOf(page, 'Rear')).y + 30,
  );
  const order = (name: string) =>
    panel(page, name).evaluate((figure) => Number(getComputedStyle(figure).zIndex));
  expect(await order('Rear')).toBeGreaterThan(await order('Front'));
  await panel(page, 'Front').click({ position: { x: 10, y: 10 } });
  expect(await order('Front')).toBeGreaterThan(await order('Rear'));

  await page.setViewportSize({ width: 700, height: 480 });
  await expect.poll(async () => (await boxOf(page, 'Rear')).x).toBeLessThan(700);
  for (const { name } of twoCameras) {
    const { x, y, width, height } = await boxOf(page, name);
    expect(Math.min(x, y)).toBeGreaterThanOrEqual(0);
    expect([x + width <= 700, y + height <= 480]).toEqual([true, true]);
  }
  await expectNothingCovered(page);
  await page.setViewportSize({ width: 960, height: 540 });

  // The browser keeps it.
  const kept = await boxOf(page, 'Front');
  await operator.reload();
  await operator.expectPoints(300);
  await expect.poll(async () => Math.round((await boxOf(page, 'Front'))?.x ?? -1)).toBe(Math.round(kept.x));
  await page.getByRole('button', { name: 'Reset panels' }).click();
  await expect.poll(async () => (await boxOf(page, 'Front')).x).toBeCloseTo(docked.x, 0);

  // What it cannot read counts as nothing.
  await page.evaluate(() =>
    localStorage.setItem('farpoint.panels', '{"panels":[{"name":"video:Front","x":7}]}'),
  );
  await operator.reload();
  await operator.expectPoints(300);
  await expect(panel(page, 'Front')).toHaveAttribute('data-floating', 'false');
});

test('one key lets a camera fill the screen and puts the cloud into its panel; driving and stopping go on', async ({
  page,
  startStack,
}, testInfo) => {
  const { operator } = await open(page, startStack);
  await expect.poll(async () => (await videos(page))[0]?.frames, { timeout: 20_000 }).toBeGreaterThan(5);
  await page.keyboard.press('KeyF');
  const filling = page.locator('#camera-stage canvas');
  await expect(filling).toBeVisible();
  expect(await filling.boundingBox()).toMatchObject({ x: 0, y: 0, width: 960, height: 540 });
  await expect(page.locator('#camera-stage p')).toHaveText(/^Front · \d+ ms$/);
  await expect(panel(page, 'Front').locator('#stage')).toBeVisible();
  const cloud = (await page.locator('#stage').boundingBox())!;
  expect(cloud.width).toBeLessThan(320);
  expect(cloud.width / cloud.height).toBeCloseTo(4 / 3, 1);
  await operator.expectFrames(5);
  const { canvas } = await operator.stats();
  expect(canvas.width).toBeLessThan(340);
  const { frames = 0 } = (await videos(page))[0] ?? {};
  await expect.poll(async () => (await videos(page))[0]?.frames).toBeGreaterThan(frames + 5);
  await expectNothingCovered(page);
  await operator.look(testInfo, 'camera-fills-screen');

  const start = await operator.body();
  await operator.holdForward();
  await operator.expectMovedFrom(start, 0.2);
  await operator.releaseKeys();
  await page.getByRole('button', { name: 'STOP' }).click();
  await operator.expectState('estop', true);
  await expectNothingCovered(page);
  await operator.releaseEstop();

  // The other camera, by its button; then the cloud again.
  await page.getByRole('button', { name: 'Fill the screen with Rear' }).click();
  await expect(page.locator('#camera-stage p')).toHaveText(/^Rear/);
  await expect(panel(page, 'Rear').locator('#stage')).toBeVisible();
  await expect(panel(page, 'Front').locator('canvas:not(#stage)')).toBeVisible();
  await page.keyboard.press('KeyF');
  await expect(page.locator('#camera-stage')).toBeHidden();
  expect(await page.locator('#stage').boundingBox()).toMatchObject({ x: 0, y: 0, width: 960, height: 540 });
  await operator.expectFrames(5);

  // A camera that is switched off does not leave a black screen.
  await page.keyboard.press('KeyF');
  await page.getByRole('button', { name: 'Hide Front' }).click();
  await expect(page.locator('#camera-stage')).toBeHidden();
  await expect(page.locator('main > #stage')).toBeVisible();
});

test('each panel says whether it is live, waiting, faulty, frozen or off, and what the compositor did is listed', async ({
  page,
  startStack,
}, testInfo) => {
  const ending = 'videotestsrc is-live=true num-buffers=90 ! video/x-raw,width=320,height=240,framerate=15/1';
  const { operator, stack } = await open(page, startStack, [
    ...twoCameras,
    camera('Arm', 'ball', { source: { kind: 'v4l2', device: '/dev/no-such-camera' } }),
    camera('Ending', 'ball', { source: { kind: 'gst', pipeline: ending } }),
  ]);
  await expect.poll(() => stateOf(page, 'Front')).toBe('live');
  await expect(panel(page, 'Front').locator('.age')).toHaveText(/^\d+ ms$/);
  // A camera that never sent a picture: the reason stands in its place.
  await expect(panel(page, 'Arm')).toHaveAttribute('data-state', 'fault');
  await expect(panel(page, 'Arm').locator('.age')).toHaveText('no picture');
  await expect(panel(page, 'Arm').locator('.fault')).toContainText('/dev/no-such-camera');
  await expect(panel(page, 'Arm').locator('canvas')).toBeHidden();
  // One that has ended: its last picture, without colours, and its age.
  await expect(panel(page, 'Ending')).toHaveAttribute('data-state', 'fault', { timeout: 40_000 });
  await expect(panel(page, 'Ending').locator('.age')).toHaveText(/^fault, \d+\.\d s$/);
  await expect(panel(page, 'Ending').locator('canvas')).toHaveCSS('filter', /grayscale/);

  await page.getByRole('button', { name: 'Hide Rear' }).click();
  await expect(panel(page, 'Rear')).toHaveAttribute('data-state', 'off');
  await expect(panel(page, 'Rear').locator('.age')).toHaveText('hidden');
  await page.getByRole('button', { name: 'Show Rear' }).click();
  await expect(panel(page, 'Rear')).toHaveAttribute('data-state', 'live');

  await page.locator('.video-report button').click();
  const report = page.locator('.video-report dl');
  await expect(report).toContainText('Front');
  await expect(report).toContainText('in step');
  await operator.look(testInfo, 'states');

  // The robot's process is killed: nothing comes, and nobody says so.
  await stack.robot(lightRobot.id).kill();
  await expect(panel(page, 'Front')).toHaveAttribute('data-state', 'frozen');
  await expect(panel(page, 'Front').locator('.age')).toHaveText(/^frozen, \d+\.\d s$/);
  await expect(panel(page, 'Front').locator('canvas')).toHaveCSS('filter', /grayscale/);
  await operator.look(testInfo, 'frozen');
  // Also where the camera fills the screen.
  await page.keyboard.press('KeyF');
  await expect(page.locator('#camera-stage p')).toHaveText(/^Front · frozen, \d+\.\d s$/);
  await expect(page.locator('#camera-stage canvas')).toHaveCSS('filter', /grayscale/);
});

test.describe('on a phone', () => {
  test.use({ viewport: { width: 360, height: 740 }, hasTouch: true });

  test('the panels stay in their strip and cover nothing; a camera can fill the screen', async ({
    page,
    startStack,
  }, testInfo) => {
    await page.addInitScript(() =>
      localStorage.setItem('farpoint.panels', '{"panels":[{"name":"video:Front","x":1,"y":1,"width":300}]}'),
    );
    const { operator } = await open(page, startStack);
    await expect(panel(page, 'Front').locator('canvas')).toBeVisible();
    await expect(panel(page, 'Front')).toHaveAttribute('data-floating', 'false');
    await expectNothingCovered(page);
    await operator.look(testInfo, 'phone-panels');
    await page.getByRole('button', { name: 'Fill the screen with Rear' }).tap();
    await expect(page.locator('#camera-stage p')).toHaveText(/^Rear/);
    await expectNothingCovered(page);
    await operator.look(testInfo, 'phone-camera-fills-screen');
    await page.getByRole('button', { name: 'Fill the screen with the cloud' }).tap();
    await expect(page.locator('#camera-stage')).toBeHidden();
  });
});

for (const width of [360, 1280, 3840]) {
  test(`what became of the frames, and what comes first on a slow link, on a screen ${width} pixels wide`, async ({
    page,
    startStack,
  }, testInfo) => {
    await page.setViewportSize({ width, height: width === 360 ? 740 : Math.round((width * 9) / 16) });
    await open(page, startStack);
    await expect.poll(() => stateOf(page, 'Front')).toBe('live');
    await page.locator('.video-report button').click();
    const choice = page.getByLabel('What comes first on a slow link');
    await choice.selectOption('cameras first');
    await expect(choice).toBeInViewport({ ratio: 1 });
    await page.screenshot({ path: testInfo.outputPath(`slow-link-${width}.png`) });
    await expectNothingCovered(page);
    // Nothing that is chosen is cut off.
    expect(await choice.evaluate((select) => select.scrollWidth <= select.clientWidth)).toBe(true);
    const [words, box] = [page.locator('.link-share > span'), await choice.boundingBox()];
    expect((await words.boundingBox())!.x + (await words.boundingBox())!.width).toBeLessThanOrEqual(box!.x);
  });
}
