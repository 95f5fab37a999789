/** The robot itself: its outline, its model, and the way that it takes of the floor. */
import type { ModelPart } from '@farpoint/protocol';
import { headsetViewport } from '../src/headset.ts';
import { enterVr } from '../src/stage/in-headset.ts';
import { expect, test } from '../src/stage/page-test.ts';
import { boxOf } from '../src/stage/pictures.ts';
import type { Rgb, Stage } from '../src/stage/stage.ts';

/** Canvas columns. */
const COLUMNS = 320;
/** Nothing else in the scene is green-blue. */
const isMarker = ([r, g, b]: Rgb) => g > 90 && b > 80 && g - r > 40;

const path = async (stage: Stage) => (await stage.state()).path;

test('the way of the present command and its end are on the floor, and turn red where the robot is held', async ({
  stage,
}) => {
  const { keyboard } = await stage.open();
  expect(await path(stage)).toBe(null);
  await keyboard.down('Space');
  await stage.run(100);
  await keyboard.down('KeyW');
  await stage.run(600);
  // At 0.5 m/s, braking at 1 m/s²: 0.125 m, and what is gone while the loop is blind.
  const driven = await path(stage);
  expect(driven?.tone).not.toBe('held');
  expect(driven?.stopM).toBeGreaterThan(0.125);
  expect(driven?.stopM).toBeLessThan(0.5);
  await stage.script(({ robot }) => {
    const motion = { factor: 0, reasons: ['obstacle' as const], mostLinear: 0.5 };
    robot.telemetry = { drive: 'blocked', motion };
  });
  await stage.run(200);
  expect((await path(stage))?.tone).toBe('held');
  await keyboard.up('KeyW');
  await keyboard.up('Space');
  await stage.run(300);
  expect(await path(stage)).toBe(null);
});

/** How large the robot's outline is on the screen, from above, metres; ahead is up. */
async function outline(stage: Stage, footprint: { x: number; y: number }[]) {
  await stage.open({ state: 'blank' });
  await stage.script((stage, footprint) => {
    stage.robot.body = { footprint, decelerationMps2: 1 };
    stage.robot.appear(stage.link);
    stage.app.choose(stage.robot.id);
  }, footprint);
  await stage.run(400);
  await stage.page.keyboard.press('t');
  await stage.page.mouse.move(160, 90);
  await stage.page.mouse.wheel(0, -1000);
  await stage.frames(20);
  const pixels = await stage.pixels();
  const box = boxOf(pixels, COLUMNS, isMarker);
  if (box === null) throw new Error('no outline is drawn');
  const metresPerPixel = (2 * (await stage.state()).scene.reachM) / (pixels.length / COLUMNS);
  return { length: box.height * metresPerPixel, width: box.width * metresPerPixel };
}

const rectangle = (x: number, y: number) => [
  { x, y },
  { x: -x, y },
  { x: -x, y: -y },
  { x, y: -y },
];

test('a robot is drawn as large as it has told', async ({ stage }) => {
  const [x, y] = [0.7, 0.6];
  const { length, width } = await outline(stage, rectangle(x, y));
  // To the middle of its lines.
  expect(Math.abs(length - 2 * x)).toBeLessThan(0.08);
  expect(Math.abs(width - 2 * y)).toBeLessThan(0.08);
});

const AT = [0, 0, 0, 0, 0, 0, 1] as const;
const PARTS: ModelPart[] = [
  { part: 'link', parent: 0, place: [0, 0.3, 0.1, 0, 0, 0, 1], moves: 'turns', axis: [0, 1, 0] },
  { part: 'link', parent: 0, place: [0, -0.3, 0.1, 0, 0, 0, 1], moves: 'turns', axis: [0, 1, 0] },
  { part: 'shape', link: 0, place: [...AT], form: 'box', size: [0.6, 0.5, 0.3], colour: 0xff2020 },
  { part: 'shape', link: 1, place: [...AT], form: 'cylinder', size: [0.1, 0.05], colour: 0x2020ff },
  { part: 'shape', link: 2, place: [...AT], form: 'cylinder', size: [0.1, 0.05], colour: 0x2020ff },
];
const SHAPES = 3;
const isRed = ([r, g, b]: Rgb) => r > 60 && r - Math.max(g, b) > 40;

async function tellModel(stage: Stage): Promise<void> {
  await stage.script((stage, parts) => {
    stage.tell({ type: 'robotModel', number: 1, count: parts.length, at: 0, parts });
  }, PARTS);
  await tellJoints(stage, [0, 0]);
}

async function tellJoints(stage: Stage, positions: number[]): Promise<void> {
  await stage.script(
    (stage, positions) =>
      stage.tell({ type: 'joints', model: 1, timeMs: stage.robot.nowMs, ageMs: 0, positions }),
    positions,
  );
  await stage.run(200);
}

const model = async (stage: Stage) => (await stage.state()).model;
const reds = async (stage: Stage) => (await stage.pixels()).filter(isRed).length;

test('the robot’s model is seen from outside only, its wheels turn, and it can be hidden', async ({
  stage,
}) => {
  const page = await stage.open();
  expect(await model(stage)).toMatchObject({ links: 0, shapes: 0, drawn: false });
  await tellModel(stage);
  expect(await model(stage)).toMatchObject({ links: 2, shapes: SHAPES, drawn: false });
  expect(await reds(stage)).toBe(0);
  for (const key of ['v', 't']) {
    await page.keyboard.press(key);
    await stage.run(300);
    expect((await model(stage)).drawn).toBe(true);
    expect(await reds(stage), key).toBeGreaterThan(20);
  }
  await tellJoints(stage, [0.5, -0.5]);
  expect((await model(stage)).positions).toEqual([expect.closeTo(0.5, 6), expect.closeTo(-0.5, 6)]);
  await page.locator('#colours-open').click();
  const shown = page.locator('#robot-model');
  await expect(shown).toHaveText('Drawn');
  await shown.click();
  await stage.run(100);
  expect(await model(stage)).toMatchObject({ shapes: 0, drawn: false });
  expect(await reds(stage)).toBe(0);
  await shown.click();
  await stage.run(100);
  expect(await reds(stage)).toBeGreaterThan(20);
});

test('a robot without a model has its outline, seen from behind', async ({ stage }) => {
  const page = await stage.open();
  const marked = async () => (await stage.pixels()).filter(isMarker).length;
  expect(await marked()).toBe(0);
  await page.keyboard.press('v');
  await stage.run(300);
  expect(await model(stage)).toMatchObject({ links: 0, shapes: 0, drawn: false });
  expect(await marked()).toBeGreaterThan(10);
});

test.describe('in the headset', () => {
  test.use({ viewport: headsetViewport });

  test('the model is seen over the shoulder, not from the robot’s own eyes', async ({ stage }) => {
    const headset = await enterVr(stage, { canvas: '320x180' });
    // The words beside a hand are red where they say STOP.
    for (const hand of ['left', 'right'] as const) await headset.place(hand, [0, 0.2, 1]);
    await tellModel(stage);
    expect(await model(stage)).toMatchObject({ shapes: SHAPES, drawn: false });
    expect(await reds(stage)).toBe(0);
    await headset.press('left', 'x-button');
    await stage.frames(5);
    expect((await model(stage)).drawn).toBe(true);
    expect(await reds(stage)).toBeGreaterThan(20);
  });
});
