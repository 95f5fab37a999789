import { Headset } from '../src/headset.ts';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, simulatedRobot, test } from '../src/stack-test.ts';
import { hasVideo, testCamera, videoRobot } from '../src/video-robot.ts';

test.skip(!hasVideo, 'needs GStreamer and `pnpm build:native video`');

/** Leaves the processor to the videos. */
const light = {
  ...simulatedRobot,
  args: [...simulatedRobot.args.slice(0, -1), '3000', '--sim-size', '96', '--fps', '10'],
};
const small = { width: 320, height: 240, framesPerS: 15, kbitPerS: 400 };
const source = (pattern: string) => ({ kind: 'test', pattern, width: 320, height: 240, framesPerS: 15 });
const cameras = ['smpte', 'pinwheel', 'ball'].map((pattern, i) =>
  testCamera(['Front', 'Left', 'Right'][i] as string, 'vp8enc', { ...small, source: source(pattern) }),
);

test('in the headset: three videos beside the wrist, one enlarged by the trigger, then in place of the cloud', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [videoRobot(light, cameras)] });
  const headset = await Headset.wear(page);
  const operator = await OperatorPage.open(page, stack, { robot: light.id });
  await operator.expectPoints(1000);
  await page.getByRole('button', { name: /VR/ }).click();
  await operator.expectState('vr', true);
  await headset.place('left', [-0.25, 1.5, -0.6]);
  const frames = async () =>
    Math.min(...(await page.evaluate(() => window.farpoint.videos())).map(({ frames }) => frames));
  const expectMore = async () => {
    const before = await frames();
    await expect.poll(frames, { timeout: 20_000 }).toBeGreaterThan(before + 3);
  };
  await expectMore();
  await operator.screenshot(testInfo, 'headset-videos');
  const shown = () =>
    page.evaluate(() => {
      const large = window.farpoint.videos().find(({ enlarged, fills }) => enlarged || fills);
      return large === undefined ? null : `${large.name} ${large.fills ? 'fills' : 'enlarged'}`;
    });

  await page.keyboard.press('KeyE');
  expect(await shown()).toBe('Front enlarged');
  await expectMore();
  await operator.screenshot(testInfo, 'headset-enlarged');
  const pull = async () => {
    await operator.expectFrames(2);
    await headset.button('right', 'trigger', 1);
    await operator.expectFrames(2);
    await headset.button('right', 'trigger', 0);
    // A trigger that the page has not yet seen open would go on releasing the stop, and another control would not.
    await operator.expectFrames(2);
  };
  // Straight ahead of the hand is the picture.
  await headset.place('right', [0.52, 1.52, -0.2]);
  await pull();
  await expect.poll(shown).toBe('Front fills');
  await expectMore();
  await operator.screenshot(testInfo, 'headset-fills');
  await headset.place('right', [0.3, 1.6, -0.2]);
  await pull();
  await expect.poll(shown).toBe(null);

  // The trigger is the emergency stop's while that is on.
  await page.keyboard.press('KeyE');
  await page.keyboard.press('KeyX');
  await operator.expectState('estop', true);
  await headset.place('right', [0.52, 1.52, -0.2]);
  await pull();
  expect(await shown()).toBe('Front enlarged');

  // The grip and the thumbstick drive as ever.
  await operator.releaseEstop();
  const start = await operator.body();
  await operator.hold(headset.grip('right'));
  await headset.thumbstick('right', 0, -1);
  await operator.expectMovedFrom(start, 0.3);
  await operator.release();
});
