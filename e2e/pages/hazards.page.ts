/** What the robot would hit and where its floor is missing is tinted, in every view; nothing else is. */
import { headsetViewport } from '../src/headset.ts';
import { enterVr, wristOf } from '../src/stage/in-headset.ts';
import { expect, test } from '../src/stage/page-test.ts';
import { screenPlace } from '../src/stage/places.ts';
import { FRAME_MS, type Rect, type Rgb, type Stage } from '../src/stage/stage.ts';
import { SURFACES } from '../src/stored.ts';

/** Grey, mixed with the tints. */
const HIT: Rgb = [205, 93, 85];
const DROP: Rgb = [161, 125, 208];
const GREY: Rgb = [130, 130, 136];
const NEAR = 14;
const LEFT = { x: 0.3, y: 0.1, width: 0.2, height: 0.75 };
const RIGHT = { x: 0.5, y: 0.1, width: 0.4, height: 0.75 };
const ABOVE = { x: 0.3, y: 0.1, width: 0.4, height: 0.35 };
const HEIGHTS = { clearanceM: 0.04, heightM: 1.1, dropM: 0.15, slope: 0.01 };

/** Shares of a part's pixels with each colour: of what would be hit, of missing floor, untinted. */
async function tints(stage: Stage, part?: Rect) {
  const hit = await stage.share(HIT, part, NEAR);
  return { hit, drop: await stage.share(DROP, part, NEAR), grey: await stage.share(GREY, part, NEAR) };
}

/** A grey room before a robot of these heights; it stands still. */
async function openRoom(stage: Stage, heights = HEIGHTS): Promise<void> {
  await stage.open({ state: 'blank', query: { every: '1' }, frameMs: FRAME_MS });
  await connect(stage, heights);
}

async function connect(stage: Stage, heights = HEIGHTS): Promise<void> {
  await stage.load('grey-room');
  await stage.script((stage, heights) => {
    const { robot } = stage;
    if (robot.body !== undefined) robot.body = { ...robot.body, heights };
    robot.appear(stage.link);
    stage.app.choose(robot.id);
  }, heights);
  await stage.run(400);
  await show(stage);
}

async function show(stage: Stage): Promise<void> {
  await stage.cloud('grey-room');
  await stage.run(300);
  await stage.cloud('grey-room');
  await stage.run(300);
}

test('what would be hit and missing floor are tinted, from the eye and from above, and the floor is not', async ({
  stage,
}) => {
  const { page } = stage;
  await openRoom(stage);
  const plain = await tints(stage);
  expect(Math.max(plain.hit, plain.drop)).toBeLessThan(0.001);
  const legend = page.locator('.legend.hazards');
  await expect(legend).toHaveCount(0);

  await page.keyboard.press('h');
  await stage.run(300);
  await expect(legend).toContainText('would hit: 0.04–1.10 m');
  await expect(legend).toContainText('drop: below −0.15 m');
  // The box is at the left, the pit at the right; the beam is passed under.
  const [left, right] = [await tints(stage, LEFT), await tints(stage, RIGHT)];
  expect(left.hit).toBeGreaterThan(0.02);
  expect(right.drop).toBeGreaterThan(0.01);
  expect(left.drop).toBeLessThan(0.001);
  expect(right.hit).toBeLessThan(0.001);
  expect((await tints(stage, ABOVE)).grey).toBeGreaterThan(0.02);
  expect((await tints(stage)).grey).toBeGreaterThan(0.04);

  await page.keyboard.press('t');
  await stage.run(500);
  // What is old is darker.
  await show(stage);
  const fromAbove = await tints(stage);
  expect(fromAbove.drop).toBeGreaterThan(0.005);
  expect(fromAbove.grey).toBeGreaterThan(0.02);
  expect(fromAbove.hit).toBeGreaterThan(0.0005);

  // Kept for the next visit, until it is switched off.
  await stage.reload();
  await connect(stage);
  await expect(legend).toContainText('would hit');
  expect((await tints(stage, LEFT)).hit).toBeGreaterThan(0.02);
  await page.keyboard.press('h');
  await stage.run(300);
  await expect(legend).toHaveCount(0);
  expect((await tints(stage)).hit).toBeLessThan(0.001);
});

test('the heights are the robot’s own: a taller one hits the beam, and takes the pit as a step', async ({
  stage,
}) => {
  await openRoom(stage, { ...HEIGHTS, heightM: 2, dropM: 0.6 });
  await stage.page.keyboard.press('h');
  await stage.run(300);
  await expect(stage.page.locator('.legend.hazards')).toContainText('would hit: 0.04–2.00 m');
  expect((await tints(stage, ABOVE)).hit).toBeGreaterThan(0.02);
  expect((await tints(stage)).drop).toBeLessThan(0.001);
});

test('surfaces are tinted as well, where they are not floor', async ({ stage }) => {
  const { page } = stage;
  await stage.open({ state: 'still', query: { every: '1' }, stored: SURFACES });
  await stage.script((stage, heights) => {
    const { welcome } = stage.link.session;
    if (welcome?.body !== undefined) stage.tell({ ...welcome, body: { ...welcome.body, heights } });
  }, HEIGHTS);
  for (let i = 0; i < 3; i++) {
    await stage.cloud('depth-room');
    await stage.run(200);
  }
  expect(await stage.probe()).toMatchObject({ surface: true });
  const box = await screenPlace(stage, { right: 0, down: 0.4 });
  const floor = await screenPlace(stage, { right: 0.5, down: 0.5 });
  const plain = [await stage.mean(box), await stage.mean(floor)];
  await page.keyboard.press('h');
  await stage.run(300);
  const tinted = [await stage.mean(box), await stage.mean(floor)];
  const change = plain.map((colour, i) =>
    Math.max(...colour.map((level, channel) => Math.abs(level - (tinted[i]?.[channel] ?? 0)))),
  );
  expect(change[0]).toBeGreaterThan(25);
  expect(change[1]).toBeLessThan(10);
});

test.describe('in the headset', () => {
  test.use({ viewport: headsetViewport });

  test('both eyes see the tints, and the wrist says what they mean', async ({ stage }) => {
    const { page } = stage;
    const headset = await enterVr(stage, {
      state: 'still',
      canvas: '320x180',
      query: { every: '1' },
      frameMs: FRAME_MS,
    });
    await stage.script((stage, heights) => {
      const { welcome } = stage.link.session;
      if (welcome?.body !== undefined) stage.tell({ ...welcome, body: { ...welcome.body, heights } });
    }, HEIGHTS);
    await show(stage);
    await page.keyboard.press('h');
    await stage.run(400);
    for (const x of [0, 0.5]) {
      const eye = { x, y: 0, width: 0.5, height: 1 };
      expect(await stage.share(HIT, eye, 20)).toBeGreaterThan(0.005);
      expect(await stage.share(DROP, eye, 20)).toBeGreaterThan(0.002);
    }
    await headset.place('left', [-0.05, 1.55, -0.35]);
    await stage.run(500);
    const words = (await wristOf(stage)).map(({ text }) => text).join('\n');
    expect(words).toContain('Red: would hit  violet: drop');
  });
});
