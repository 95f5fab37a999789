/** The cameras' videos in the headset: beside the wrist, enlarged, and in place of the cloud. */
import { type Headset, headsetViewport } from '../src/headset.ts';
import { enterVr } from '../src/stage/in-headset.ts';
import { expect, test } from '../src/stage/page-test.ts';
import type { Rgb, Stage } from '../src/stage/stage.ts';
import { videosOf } from '../src/stage/videos.ts';

test.use({ viewport: headsetViewport });

const FRONT: Rgb = [250, 0, 250];
const LEFT: Rgb = [250, 250, 0];
const RIGHT: Rgb = [0, 250, 250];
/** What is left of it at a third of its lightness. */
const DARK_FRONT: Rgb = [83, 0, 83];
const CHANGED: Rgb = [0, 0, 250];
/** Where a hand points straight at the enlarged picture, and at the one that fills the view: right, up, back, metres. */
const AT_ENLARGED = [0.52, 1.52, -0.2] as const;
const AT_FILLING = [0.3, 1.6, -0.2] as const;

/** The shares of the three cameras' colours in what both eyes see: the smaller one of each. */
async function seen(stage: Stage, front = FRONT): Promise<{ front: number; left: number; right: number }> {
  await stage.run(300);
  const eyes: Rgb[][] = [];
  for (const x of [0, 0.5]) eyes.push(await stage.pixels({ x, y: 0, width: 0.5, height: 1 }));
  const share = (colour: Rgb) =>
    Math.min(
      ...eyes.map((pixels) => {
        const near = pixels.filter((pixel) => pixel.every((level, i) => level === colour[i]));
        return near.length / pixels.length;
      }),
    );
  return { front: share(front), left: share(LEFT), right: share(RIGHT) };
}

/** The video that is shown large; `null`: none. */
async function large(stage: Stage): Promise<string | null> {
  const video = (await videosOf(stage)).find(({ enlarged, fills }) => enlarged || fills);
  return video === undefined ? null : `${video.name} ${video.fills ? 'fills' : 'enlarged'}`;
}

async function pullAt(headset: Headset, [x, y, z]: readonly [number, number, number]): Promise<void> {
  await headset.place('right', [x, y, z]);
  await headset.frames(2);
  await headset.press('right', 'trigger');
}

test('three videos beside the wrist, one enlarged by a key, then by the trigger in place of the cloud', async ({
  stage,
}) => {
  const { page } = stage;
  const headset = await enterVr(stage, { state: 'still' });
  const videos = ['Front', 'Left', 'Right'].map((name, i) => ({ name, mid: `v${i}`, codec: 'VP8' as const }));
  await stage.tell({ type: 'videos', videos });
  const play = (front: Rgb) =>
    stage.script(
      (stage, [front, left, right]) =>
        stage.play({ Front: { colour: front }, Left: { colour: left }, Right: { colour: right } }),
      [front, LEFT, RIGHT] as const,
    );
  await play(FRONT);
  await headset.place('left', [-0.25, 1.5, -0.6]);
  // Until the sign before the eyes, which covers a hand that is held behind it, has told of the connection.
  await stage.run(5500);
  const wrist = await seen(stage);
  for (const share of Object.values(wrist)) expect(share).toBeGreaterThan(0.01);
  expect(await large(stage)).toBe(null);

  await page.keyboard.press('KeyE');
  expect(await large(stage)).toBe('Front enlarged');
  const enlarged = await seen(stage);
  expect(enlarged.front).toBeGreaterThan(2 * wrist.front);
  // The others move up.
  expect(enlarged.left).toBe(wrist.front);
  expect(enlarged.right).toBe(wrist.left);

  // Straight ahead of the hand is the picture.
  await pullAt(headset, AT_ENLARGED);
  expect(await large(stage)).toBe('Front fills');
  const fills = await seen(stage);
  expect(fills.front).toBeGreaterThan(3 * enlarged.front);
  // It goes on.
  await play(CHANGED);
  expect(await seen(stage)).toMatchObject({ front: 0 });
  expect(await seen(stage, CHANGED)).toEqual(fills);
  await play(FRONT);
  await pullAt(headset, AT_FILLING);
  expect(await large(stage)).toBe(null);
  expect(await seen(stage)).toEqual(wrist);

  // What does not go on any more is dark.
  await stage.script((stage) => stage.play(null));
  await stage.run(1300);
  expect(await seen(stage)).toEqual({ front: 0, left: 0, right: 0 });
  expect((await seen(stage, DARK_FRONT)).front).toBe(wrist.front);
  await play(FRONT);

  // The trigger is the emergency stop's while that is on.
  await page.keyboard.press('KeyE');
  await page.keyboard.press('KeyX');
  await stage.frames(3);
  expect((await stage.state()).estop).toBe(true);
  await pullAt(headset, AT_ENLARGED);
  expect(await large(stage)).toBe('Front enlarged');
  expect((await stage.state()).estop).toBe(true);
  await headset.button('right', 'trigger', 1);
  await stage.run(1200);
  expect((await stage.state()).estop).toBe(false);
  await headset.button('right', 'trigger', 0);
  await stage.frames(3);
  expect(await large(stage)).toBe('Front enlarged');

  // The grip and the thumbstick drive as ever.
  await headset.button('right', 'squeeze', 1);
  await headset.thumbstick('right', 0, -1);
  await stage.run(1000);
  const { body, driving } = await stage.state();
  expect(driving).toBe(true);
  expect(body?.x).toBeGreaterThan(0.3);
  expect(await large(stage)).toBe('Front enlarged');
});
