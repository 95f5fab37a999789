/** What the robot would hit and where its floor is missing is tinted, in every view; nothing else is. */
import type { Page, TestInfo } from '@playwright/test';
import { writeGreyRoom } from '../src/grey-room.ts';
import { enterVr, Headset, headsetViewport } from '../src/headset.ts';
import { expectOnScreenAndApart } from '../src/layout.ts';
import { OperatorPage, screenSizes } from '../src/operator-page.ts';
import { leftEye, type Part, type Rgb, redder, rightEye, sharesNear } from '../src/picture.ts';
import { expect, LONG, test } from '../src/stack-test.ts';

/** What the legend may not cover, and what may not cover it. */
const CONTROLS =
  '#bar button:visible, #drive button:visible, #joystick:visible, #holder, #clouds .heads button, #clouds .legend';
/** Grey, mixed with the tints. */
const HIT: Rgb = [205, 93, 85];
const DROP: Rgb = [161, 125, 208];
const GREY: Rgb = [130, 130, 136];
const NEAR = 14;
const left: Part = { left: 0.3, top: 0.1, width: 0.2, height: 0.75 };
const right: Part = { left: 0.5, top: 0.1, width: 0.4, height: 0.75 };
const above: Part = { left: 0.3, top: 0.1, width: 0.4, height: 0.35 };
const whole: Part = { left: 0, top: 0, width: 1, height: 1 };

function roomRobot(testInfo: TestInfo, more: readonly string[] = []) {
  const path = testInfo.outputPath('room.pcd');
  writeGreyRoom(path);
  const stream = ['--mode', 'points64', '--fps', '5', '--bitrate-mbps', '40', '--lambda', '0'];
  return {
    id: 'room',
    name: 'Grey room',
    args: ['--source', 'pcd', '--path', path, ...stream, ...more],
  };
}

/** Share of a part's pixels with each colour: of what would be hit, of missing floor, untinted. */
async function tints(page: Page, part: Part): Promise<{ hit: number; drop: number; grey: number }> {
  const [hit = 0, drop = 0, grey = 0] = await sharesNear(
    page,
    await page.screenshot(),
    part,
    [HIT, DROP, GREY],
    NEAR,
  );
  return { hit, drop, grey };
}

test('what would be hit and missing floor are tinted, from the eye and from above, and the floor is not', async ({
  page,
  startStack,
}, testInfo) => {
  const robot = roomRobot(testInfo);
  const stack = await startStack({ robots: [robot] });
  const operator = await OperatorPage.open(page, stack, { robot: robot.id, every: '1' });
  await operator.expectPoints(15_000);
  const plain = await tints(page, whole);
  expect(Math.max(plain.hit, plain.drop)).toBeLessThan(0.001);
  await expect(page.locator('.legend.hazards')).toHaveCount(0);

  await page.keyboard.press('h');
  const legend = page.locator('.legend.hazards');
  await expect(legend).toContainText('would hit: 0.04–1.10 m');
  await expect(legend).toContainText('drop: below −0.15 m');
  await expect.poll(async () => (await tints(page, left)).hit).toBeGreaterThan(0.02);
  await expect.poll(async () => (await tints(page, right)).drop).toBeGreaterThan(0.01);
  // The box is at the left, the pit at the right; the beam is passed under.
  expect((await tints(page, left)).drop).toBeLessThan(0.001);
  expect((await tints(page, right)).hit).toBeLessThan(0.001);
  expect((await tints(page, above)).grey).toBeGreaterThan(0.02);
  expect((await tints(page, whole)).grey).toBeGreaterThan(0.04);
  for (const size of screenSizes) {
    await page.setViewportSize(size);
    await operator.expectFrames(2);
    await operator.look(testInfo, `eye-${size.width}`);
    await expectOnScreenAndApart(page.locator(CONTROLS), size);
  }
  const small = { width: 960, height: 540 };
  await page.setViewportSize(small);
  await operator.look(testInfo, 'eye-960');
  await expectOnScreenAndApart(page.locator(CONTROLS), small);

  // In the colours of a quantity, too.
  await page.locator('#colours-open').click();
  await expect(page.locator('#hazards')).toHaveText('Tinted');
  await page.getByLabel('Colours of Cloud').selectOption('height');
  await operator.expectFrames(2);
  await operator.look(testInfo, 'height');
  await page.getByLabel('Colours of Cloud').selectOption('captured');
  await page.locator('#colours-open').click();

  await page.keyboard.press('t');
  await expect.poll(async () => (await tints(page, whole)).drop).toBeGreaterThan(0.005);
  const fromAbove = await tints(page, whole);
  expect(fromAbove.grey).toBeGreaterThan(0.02);
  expect(fromAbove.hit).toBeGreaterThan(0.0005);
  for (const size of screenSizes) {
    await page.setViewportSize(size);
    await operator.expectFrames(2);
    await operator.look(testInfo, `above-${size.width}`);
  }
  await page.setViewportSize({ width: 960, height: 540 });
  await page.keyboard.press('t');

  // Kept for the next visit, until it is switched off.
  await operator.reload();
  await expect(legend).toContainText('would hit');
  await expect.poll(async () => (await tints(page, left)).hit).toBeGreaterThan(0.02);
  await page.keyboard.press('h');
  await expect(legend).toHaveCount(0);
  await expect.poll(async () => (await tints(page, whole)).hit).toBeLessThan(0.001);
});

test('the heights are the robot’s own: a taller one hits the beam', async ({
  page,
  startStack,
}, testInfo) => {
  const robot = roomRobot(testInfo, ['--guard-height-m', '2', '--guard-drop-m', '0.6']);
  const stack = await startStack({ robots: [robot] });
  const operator = await OperatorPage.open(page, stack, { robot: robot.id, every: '1' });
  await operator.expectPoints(15_000);
  await page.keyboard.press('h');
  await expect(page.locator('.legend.hazards')).toContainText('would hit: 0.04–2.00 m');
  await expect.poll(async () => (await tints(page, above)).hit).toBeGreaterThan(0.02);
  // The pit is a step that it takes.
  expect((await tints(page, whole)).drop).toBeLessThan(0.001);
  await operator.look(testInfo, 'tall');
});

test(
  'surfaces are tinted as well, where they are not floor',
  { tag: LONG },
  async ({ page, startStack }, testInfo) => {
    const robot = {
      id: 'surface',
      name: 'Surface',
      args: [
        ...['--source', 'sim', '--sim-seed', '1', '--sim-size', '192', '--fps', '5'],
        // A rate that falls on a busy machine would take the picture's quality, and its floor would differ from itself.
        ...['--rate-control', 'fixed', '--bitrate-mbps', '20'],
      ],
    };
    const stack = await startStack({ robots: [robot] });
    const operator = await OperatorPage.open(page, stack, {
      ...{ robot: robot.id, canvas: '320x240', surface: '1', every: '1', memory: '1' },
    });
    await operator.expectPoints(20_000);
    expect(await operator.probe()).toMatchObject({ surface: true });
    const pillar: Part = { left: 0.52, top: 0.5, width: 0.045, height: 0.1 };
    const floor: Part = { left: 0.4, top: 0.66, width: 0.2, height: 0.06 };
    // People may walk through the picture.
    await expect
      .poll(
        async () => {
          const plain = await operator.screenshot(testInfo, 'surface-plain');
          await page.keyboard.press('h');
          await expect(page.locator('.legend.hazards')).toBeVisible();
          await operator.expectFrames(2);
          const tinted = await operator.screenshot(testInfo, 'surface-tinted');
          await page.keyboard.press('h');
          await operator.expectFrames(2);
          // The points of a floor differ a little in each cloud, but not towards red.
          const [ofPillar, ofFloor] = await Promise.all(
            [pillar, floor].map((part) => redder(page, plain, tinted, part)),
          );
          return (ofPillar as number) > 40 && Math.abs(ofFloor as number) < 20;
        },
        { message: 'the pillar is tinted and the floor is not' },
      )
      .toBe(true);
  },
);

test.describe('in the headset', () => {
  test.use({ viewport: headsetViewport });

  test('both eyes see the tints, and the wrist says what they mean', async ({
    page,
    startStack,
  }, testInfo) => {
    const robot = roomRobot(testInfo);
    const stack = await startStack({ robots: [robot] });
    const headset = await Headset.wear(page);
    const operator = await OperatorPage.open(page, stack, { robot: robot.id, every: '1' });
    await operator.expectPoints(15_000);
    await page.keyboard.press('h');
    await enterVr(page, operator);
    for (const eye of [leftEye, rightEye]) {
      await expect.poll(async () => (await tints(page, eye)).hit).toBeGreaterThan(0.005);
      await expect.poll(async () => (await tints(page, eye)).drop).toBeGreaterThan(0.002);
    }
    await operator.look(testInfo, 'headset');
    await headset.place('left', [-0.05, 1.55, -0.35]);
    const wrist = async () =>
      (await page.evaluate(() => window.farpoint.wrist() ?? [])).map(({ text }) => text).join('\n');
    await expect.poll(wrist).toContain('Red: would hit  violet: drop');
    await operator.expectFrames(3);
    await operator.look(testInfo, 'wrist');
  });
});
