/** Turning, recentring, posture, handedness and views in the headset. */
import { headsetViewport } from '../src/headset.ts';
import { enterVr, shownIn, wristOf } from '../src/stage/in-headset.ts';
import { expect, test } from '../src/stage/page-test.ts';
import type { Stage } from '../src/stage/stage.ts';

test.use({ viewport: headsetViewport });

/** The emulated eyes are so far beside the middle of the head, metres. */
const EYE_M = 0.04;
const degrees = (radians: number) => (radians * 180) / Math.PI;

async function cameraOf(stage: Stage) {
  const { camera } = await stage.probe();
  if (camera === null) throw new Error('no cloud is drawn');
  return camera;
}

/** From the eyes to the robot's camera, metres. */
async function away(stage: Stage): Promise<number> {
  const [{ eyes }, at] = [await shownIn(stage), await cameraOf(stage)];
  return Math.hypot(eyes.x - at.x, eyes.y - at.y, eyes.z - at.z);
}

test('the room stays where it is while the robot turns; the other stick turns the view in steps', async ({
  stage,
}) => {
  const headset = await enterVr(stage);
  const { yaw } = await shownIn(stage);
  await headset.button('right', 'squeeze', 1);
  await headset.thumbstick('right', -1, 0);
  await stage.run(1200);
  expect((await stage.state()).body?.yaw).toBeGreaterThan(0.7);
  expect(await shownIn(stage)).toMatchObject({ yaw, darkness: 0 });

  // The view turns by the hand that does not drive, and the robot drives on.
  await headset.thumbstick('left', 1, 0);
  await stage.frames(10);
  expect(degrees((await shownIn(stage)).yaw - yaw)).toBeCloseTo(-30, 6);
  expect((await stage.state()).driving).toBe(true);
  await headset.thumbstick('left', 0, 0);
  await stage.frames(3);
  await headset.thumbstick('left', -1, 1);
  await stage.frames(10);
  expect(degrees((await shownIn(stage)).yaw - yaw)).toBeCloseTo(0, 6);
  // The robot's front has turned out of sight, to the left.
  expect((await shownIn(stage)).frontSide).toBe(-1);

  // Without its grip, a stick moves nothing.
  await headset.button('right', 'squeeze', 0);
  await headset.thumbstick('right', 0, 0);
  await headset.thumbstick('left', 0, -1);
  await headset.button('left', 'squeeze', 1);
  await stage.run(300);
  expect(await stage.state()).toMatchObject({ driving: false, velocity: { linear: 0, angular: 0 } });
});

test('recentring puts the eyes at the robot’s camera and looks along its heading', async ({ stage }) => {
  const headset = await enterVr(stage);
  expect(await away(stage)).toBeLessThan(EYE_M);
  await headset.head([0.6, 1.2, 0.5], 1.2);
  await headset.thumbstick('left', 1, 0);
  await stage.frames(5);
  await headset.thumbstick('left', 0, 0);
  expect(await away(stage)).toBeGreaterThan(0.7);
  await headset.press('left', 'thumbstick');
  expect(await away(stage)).toBeLessThan(EYE_M);
  expect(degrees((await shownIn(stage)).yaw - (await cameraOf(stage)).yaw)).toBeCloseTo(0, 1);

  // The keyboard does the same, for whoever helps the one in the headset.
  await headset.head([0, 1.6, 0], 0);
  await stage.frames(3);
  expect(await away(stage)).toBeGreaterThan(0.7);
  await stage.page.keyboard.press('KeyC');
  await stage.frames(3);
  expect(await away(stage)).toBeLessThan(EYE_M);
});

test('standing: the eyes are as high above the robot’s floor as above one’s own', async ({ stage }) => {
  const headset = await enterVr(stage, {}, { posture: 'standing' });
  const height = async () => (await shownIn(stage)).eyes.z - ((await stage.state()).body?.z ?? Number.NaN);
  expect(await height()).toBeCloseTo(1.6, 2);
  await headset.head([0.4, 1.75, 0]);
  await headset.press('left', 'thumbstick');
  expect(await height()).toBeCloseTo(1.75, 2);
});

test('the display has the highest refresh rate that is offered and wanted, and settings are kept', async ({
  stage,
}) => {
  const { page } = stage;
  await enterVr(stage, {}, { frameRate: 85, foveation: 0.5 });
  // The emulated one offers 72, 80, 90 and 120, and begins with 90.
  expect((await shownIn(stage)).frameRate).toBe(80);
  // The emulated headset's picture lies over the page.
  await page.getByRole('button', { name: 'Leave VR' }).dispatchEvent('click');
  await stage.frames(5);
  expect((await stage.state()).vr).toBe(false);
  await page.getByRole('button', { name: 'Settings' }).click();
  await page.getByLabel('Refresh rate').selectOption('120');
  await page.getByLabel('Turning').selectOption('smooth');
  await page.getByRole('button', { name: 'Save' }).click();
  const text = await page.evaluate(() => localStorage.getItem('farpoint.settings'));
  expect(JSON.parse(text ?? '{}').headset).toMatchObject({
    ...{ frameRate: 120, turn: 'smooth', foveation: 0.5 },
  });
  // The page was not loaded anew.
  await page.getByRole('button', { name: 'Enter VR' }).click();
  await stage.frames(20);
  expect((await shownIn(stage)).frameRate).toBe(120);
});

test('left-handed: the left hand drives, and the panel is on the right wrist', async ({ stage }) => {
  const headset = await enterVr(stage, {}, { driveHand: 'left' });
  await headset.place('right', [0.05, 1.55, -0.35]);
  await headset.button('right', 'squeeze', 1);
  await headset.thumbstick('right', 0, -1);
  await stage.run(300);
  expect((await stage.state()).driving).toBe(false);
  expect(await wristOf(stage)).not.toEqual([]);
  await headset.button('right', 'squeeze', 0);
  await headset.button('left', 'squeeze', 1);
  await headset.thumbstick('left', 0, -1);
  await stage.run(400);
  expect(await stage.state()).toMatchObject({ driving: true, velocity: { linear: 0.5 } });
});

test('an alarm is on the wrist, the worst of several is counted, and is of the past when the robot is not heard', async ({
  stage,
}) => {
  const headset = await enterVr(stage);
  await headset.place('left', [-0.05, 1.55, -0.35]);
  const raise = (number: number, level: 'ok' | 'warn' | 'error', text: string) =>
    stage.script(
      (stage, [number, level, text]) =>
        stage.tell({
          ...{ type: 'alarm', number, level, text, value: 15, limit: 20, unit: '%' },
          sinceMs: stage.robot.nowMs,
        }),
      [number, level, text] as const,
    );
  const alarms = async () => (await wristOf(stage)).filter(({ text }) => text.startsWith('⚠'));
  const low = '⚠ The battery is low (15 %, limit 20 %)';
  await stage.run(300);
  expect(await alarms()).toEqual([]);
  await raise(0, 'error', 'The battery is low');
  await stage.run(400);
  expect(await alarms()).toEqual([{ text: low, tone: 'bad' }]);
  // A second one is counted, and is not the first: it is only a warning.
  await raise(1, 'warn', 'The robot is fast');
  await stage.run(400);
  expect(await alarms()).toEqual([{ text: `${low} (and 1 more)`, tone: 'bad' }]);
  await raise(1, 'ok', 'The robot is fast');
  await stage.run(400);
  expect(await alarms()).toEqual([{ text: low, tone: 'bad' }]);
  await stage.script((stage) => stage.cut());
  await stage.run(3000);
  expect((await alarms()).map(({ text }) => text.replace(/\d+ s ago/, 'N s ago'))).toEqual([
    `${low}, N s ago`,
  ]);
  await stage.script((stage) => stage.restore());
  await stage.run(500);
  expect(await alarms()).toEqual([{ text: low, tone: 'bad' }]);
});
