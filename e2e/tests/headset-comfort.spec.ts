/** Turning, recentring, posture and handedness in the headset. */
import type { HeadsetProbe } from '@farpoint/webxr/test-api';
import type { Page } from '@playwright/test';
import { enterVr, Headset, headsetViewport } from '../src/headset.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';

test.use({ viewport: headsetViewport });

const robot = { ...lightRobot, args: [...lightRobot.args.slice(0, -1), '15'] };
/** The emulated eyes are so far beside the middle of the head, metres. */
const EYE_M = 0.04;
const degrees = (radians: number) => (radians * 180) / Math.PI;

async function probe(page: Page): Promise<HeadsetProbe> {
  const shown = await page.evaluate(() => window.farpoint.headset());
  if (shown === null) throw new Error('not in VR');
  return shown;
}

/** Waits until the robot has turned by so much, radians, while a hand drives. */
async function expectTurned(operator: OperatorPage, from: number, least: number): Promise<void> {
  await expect
    .poll(
      async () => {
        await operator.gripAnew();
        return Math.abs((await operator.body()).yaw - from);
      },
      { message: 'radians turned', intervals: [100] },
    )
    .toBeGreaterThan(least);
}

/** Opens the page on a robot of few points, and enters VR. */
async function enter(page: Page, startStack: () => Promise<Parameters<typeof OperatorPage.open>[1]>) {
  const operator = await OperatorPage.open(page, await startStack(), { robot: robot.id });
  await operator.expectPoints(300);
  await enterVr(page, operator);
  await operator.expectFrames(3);
  return operator;
}

test('in the headset the room stays where it is while the robot turns; the other stick turns the view in steps', async ({
  page,
  startStack,
}, testInfo) => {
  const headset = await Headset.wear(page);
  const operator = await enter(page, () => startStack({ robots: [robot] }));
  const { yaw } = await probe(page);
  const start = await operator.body();
  expect(degrees(yaw - start.yaw)).toBeCloseTo(0, 0);

  await operator.hold(headset.grip('right'));
  await headset.thumbstick('right', -1, 0);
  await expectTurned(operator, start.yaw, 0.7);
  expect((await probe(page)).yaw).toBe(yaw);
  expect((await probe(page)).darkness).toBe(0);

  // The view turns by the hand that does not drive, and the robot drives on.
  await operator.gripAnew();
  await headset.thumbstick('left', 1, 0);
  await headset.frames(10);
  expect(degrees((await probe(page)).yaw - yaw)).toBeCloseTo(-30, 6);
  const { yaw: turned } = await operator.body();
  await expectTurned(operator, turned, 0.2);
  await headset.thumbstick('right', 0, 0);
  await headset.thumbstick('left', 0, 0);
  await headset.frames(3);
  await headset.thumbstick('left', -1, 1);
  await headset.frames(10);
  expect(degrees((await probe(page)).yaw - yaw)).toBeCloseTo(0, 6);
  await operator.release();
  await operator.expectStanding();
  // The robot's front has turned out of sight: to the left, or, where a slow machine let it turn on, past the back.
  const left = Math.sin((await operator.body()).yaw - yaw) > 0;
  await expect.poll(async () => (await probe(page)).frontSide).toBe(left ? -1 : 1);
  await operator.look(testInfo, 'world-fixed');

  // Without its grip, a stick moves nothing.
  await headset.thumbstick('right', 0, 0);
  await headset.thumbstick('left', 0, -1);
  await headset.button('left', 'squeeze', 1);
  await operator.expectFrames(5);
  const { driving, velocity } = await operator.state();
  expect({ driving, linear: velocity?.linear }).toEqual({ driving: false, linear: 0 });
});

test('in the headset, set to turn with the robot: the view does, and its edge is dark meanwhile', async ({
  page,
  startStack,
}, testInfo) => {
  const headset = await Headset.wear(page);
  await headset.settings({ turn: 'robot', vignette: 1 });
  const operator = await enter(page, () => startStack({ robots: [robot] }));
  await operator.look(testInfo, 'standing-still');
  const { yaw } = await probe(page);
  const start = await operator.body();
  await operator.hold(headset.grip('right'));
  await headset.thumbstick('right', -1, 0);
  await expectTurned(operator, start.yaw, 0.5);
  const darkness = async () => {
    await operator.gripAnew();
    return (await probe(page)).darkness;
  };
  await expect.poll(darkness, { message: 'darkness', intervals: [50] }).toBeGreaterThan(0.5);
  expect((await probe(page)).yaw - yaw).toBeGreaterThan(0.3);
  await operator.look(testInfo, 'turning');
  await operator.release();
  await operator.expectStanding();
  await expect.poll(async () => (await probe(page)).darkness).toBe(0);
});

test('in the headset, set to turn steadily: the other stick turns the view, with a dark edge', async ({
  page,
  startStack,
}, testInfo) => {
  const headset = await Headset.wear(page);
  await headset.settings({ turn: 'smooth', vignette: 0.8 });
  await enter(page, () => startStack({ robots: [robot] }));
  const { yaw } = await probe(page);
  await headset.thumbstick('left', -1, 0);
  await expect.poll(async () => (await probe(page)).yaw - yaw).toBeGreaterThan(0.5);
  const { darkness } = await probe(page);
  await page.screenshot({ path: testInfo.outputPath('turning.png') });
  expect(darkness).toBeGreaterThan(0.4);
  await headset.thumbstick('left', 0, 0);
  await expect.poll(async () => (await probe(page)).darkness).toBe(0);
});

test('in the headset: recentring puts the eyes at the robot’s camera and looks along its heading', async ({
  page,
  startStack,
}, testInfo) => {
  const headset = await Headset.wear(page);
  const operator = await enter(page, () => startStack({ robots: [robot] }));
  const camera = async () => {
    const { camera } = await operator.probe();
    if (camera === null) throw new Error('no camera');
    return camera;
  };
  const away = async () => {
    const [{ eyes }, at] = [await probe(page), await camera()];
    return Math.hypot(eyes.x - at.x, eyes.y - at.y, eyes.z - at.z);
  };
  expect(await away()).toBeLessThan(EYE_M);
  await headset.head([0.6, 1.2, 0.5], 1.2);
  await headset.thumbstick('left', 1, 0);
  await headset.frames(5);
  await headset.thumbstick('left', 0, 0);
  expect(await away()).toBeGreaterThan(0.7);
  await headset.press('left', 'thumbstick');
  expect(await away()).toBeLessThan(EYE_M);
  const { yaw } = await probe(page);
  expect(degrees(yaw - (await camera()).yaw)).toBeCloseTo(0, 1);
  await operator.look(testInfo, 'recentred');

  // The keyboard does the same, for whoever helps the one in the headset.
  await headset.head([0, 1.6, 0], 0);
  await headset.frames(3);
  expect(await away()).toBeGreaterThan(0.7);
  await page.keyboard.press('KeyC');
  await headset.frames(3);
  expect(await away()).toBeLessThan(EYE_M);
});

test('in the headset, standing: the eyes are as high above the robot’s floor as above one’s own', async ({
  page,
  startStack,
}, testInfo) => {
  const headset = await Headset.wear(page);
  await headset.settings({ posture: 'standing' });
  const operator = await enter(page, () => startStack({ robots: [robot] }));
  const ground = (await operator.state()).body?.z ?? Number.NaN;
  const height = async () => (await probe(page)).eyes.z - ground;
  await expect.poll(height).toBeCloseTo(1.6, 2);
  await headset.head([0.4, 1.75, 0]);
  await headset.press('left', 'thumbstick');
  await expect.poll(height).toBeCloseTo(1.75, 2);
  await operator.look(testInfo, 'standing');
});

test('in the headset the display has the highest refresh rate that is offered and wanted, also when that changes', async ({
  page,
  startStack,
}) => {
  const headset = await Headset.wear(page);
  await headset.settings({ frameRate: 85, foveation: 0.5 });
  await enter(page, () => startStack({ robots: [robot] }));
  // The emulated one offers 72, 80, 90 and 120, and begins with 90.
  await expect.poll(async () => (await probe(page)).frameRate).toBe(80);
  // The emulated headset's picture lies over the page.
  await page.getByRole('button', { name: 'Leave VR' }).dispatchEvent('click');
  await page.waitForFunction(() => !window.farpoint.state().vr);
  await page.evaluate(() => Object.assign(window, { stillHere: true }));
  await page.getByRole('button', { name: 'Settings' }).click();
  await page.getByText('Headset', { exact: true }).click();
  await page.getByLabel('Refresh rate').selectOption('120');
  await page.getByLabel('Turning').selectOption('smooth');
  await page.setViewportSize({ width: 640, height: 960 });
  await page.screenshot({ path: test.info().outputPath('settings.png') });
  await page.getByRole('button', { name: 'Save', exact: true }).click();
  // Neither the page nor the session begins anew.
  expect(await page.evaluate(() => 'stillHere' in window)).toBe(true);
  const kept = await page.evaluate(() => JSON.parse(localStorage.getItem('farpoint.settings') ?? '{}'));
  expect(kept.headset).toMatchObject({ frameRate: 120, turn: 'smooth', foveation: 0.5 });
  await page.getByRole('button', { name: 'Enter VR' }).click();
  await expect.poll(async () => (await probe(page)).frameRate).toBe(120);
  const { yaw } = await probe(page);
  await headset.thumbstick('left', -1, 0);
  // On and on: one step, as before, would be 0.52.
  await expect.poll(async () => (await probe(page)).yaw - yaw).toBeGreaterThan(0.7);
});

test('in the headset, left-handed: the left hand drives, and the panel is on the right wrist', async ({
  page,
  startStack,
}, testInfo) => {
  const headset = await Headset.wear(page);
  await headset.settings({ driveHand: 'left' });
  const operator = await enter(page, () => startStack({ robots: [robot] }));
  await headset.place('right', [0.05, 1.55, -0.35]);
  await operator.look(testInfo, 'left-handed');
  const start = await operator.body();
  await headset.button('right', 'squeeze', 1);
  await headset.thumbstick('right', 0, -1);
  await operator.expectFrames(5);
  expect((await operator.state()).driving).toBe(false);
  await headset.button('right', 'squeeze', 0);
  await operator.hold(headset.grip('left'));
  await headset.thumbstick('left', 0, -1);
  await operator.expectMovedFrom(start, 0.2);
  await operator.release();
  await operator.expectStanding();
});
