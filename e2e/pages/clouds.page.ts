/** Clouds in all their forms: what is decoded is drawn, where it is, as a surface or as points, and without holes. */

import { POINTS_PER_PACKET } from '@farpoint/protocol';
import { greyRoom } from '../src/grey-room.ts';
import { lidarYard } from '../src/lidar-yard.ts';
import { expect, test } from '../src/stage/page-test.ts';
import { changedShare } from '../src/stage/pictures.ts';
import { screenPlace } from '../src/stage/places.ts';
import type { Rgb, Stage } from '../src/stage/stage.ts';
import { SURFACES, SURFACES_ALONE } from '../src/stored.ts';

const BACKGROUND: Rgb = [11, 15, 20];
/** Of the canvas, where the wall and the box are. */
const MIDDLE = { x: 0.35, y: 0.4, width: 0.3, height: 0.3 };
/** The usual height of the grid, slightly below the robot's base, and how far the view from above reaches, metres. */
const USUAL = { gridM: -0.01, reachM: 6 };

/** Sends a cloud some times, and draws it. */
async function show(stage: Stage, name: string, options: Parameters<Stage['cloud']>[1] = {}, times = 3) {
  let packets = 0;
  for (let i = 0; i < times; i++) {
    packets = await stage.cloud(name, options);
    await stage.run(200);
  }
  return packets;
}

const holes = (stage: Stage) => stage.share(BACKGROUND, MIDDLE, 4);

test('points are drawn where the robot has seen them, all of them, and lost packets cost only their own', async ({
  stage,
}) => {
  await stage.open({ state: 'still', query: { every: '1' } });
  const packets = await show(stage, 'grey-room');
  const whole = await stage.probe();
  expect(whole.surface).toBe(false);
  // Every point of the scene: x ahead, y to the left, z over base_link's floor, metres.
  expect(whole.points).toBeGreaterThan(20_000);
  const { min, max } = whole.bounds ?? { min: [], max: [] };
  expect(min[0]).toBeCloseTo(0.6, 1);
  expect(max[0]).toBeCloseTo(5.4, 1);
  expect(min[1]).toBeCloseTo(-1.8, 1);
  expect(max[1]).toBeCloseTo(1.8, 1);
  expect(min[2]).toBeCloseTo(-greyRoom.pit.depth, 2);
  expect(max[2]).toBeCloseTo(greyRoom.beam.to, 1);
  expect((await stage.stats()).packetsLost).toBe(0);

  await stage.forget();
  const lose = [3, 7];
  await show(stage, 'grey-room', { lose }, 1);
  expect((await stage.stats()).packetsLost).toBe(lose.length);
  expect(whole.points - (await stage.probe()).points).toBe(lose.length * POINTS_PER_PACKET);
  expect(packets).toBeGreaterThan(100);
});

test('a LiDAR over ground that its robot does not know of: the grid lies on it, and the yard fits the screen', async ({
  stage,
}) => {
  const page = await stage.open({ state: 'still', query: { every: '1' } });
  expect((await stage.state()).scene).toEqual(USUAL);
  await show(stage, 'lidar-yard', {}, 12);
  const scene = async () => (await stage.state()).scene;
  expect(Math.abs((await scene()).gridM - lidarYard.groundM)).toBeLessThan(0.1);
  const { reachM } = await scene();
  expect(reachM).toBeGreaterThan(lidarYard.wallM);
  // A few points are 120 m away.
  expect(reachM).toBeLessThan(40);
  await page.keyboard.press('t');
  await stage.run(300);
  // The operator's own zoom stays until it is reset.
  await page.mouse.move(160, 90);
  await page.mouse.wheel(0, -1000);
  await stage.run(300);
  const zoomed = (await scene()).reachM;
  expect(zoomed).toBeLessThan(reachM / 2);
  await show(stage, 'lidar-yard');
  expect((await scene()).reachM).toBe(zoomed);
  await page.keyboard.press('c');
  await show(stage, 'lidar-yard');
  expect((await scene()).reachM / reachM).toBeCloseTo(1, 1);
});

test('a depth camera’s cloud is drawn as a surface, and a button changes to points', async ({ stage }) => {
  const page = await stage.open({ state: 'still', query: { every: '1' }, stored: SURFACES });
  await show(stage, 'depth-room');
  expect((await stage.probe()).surface).toBe(true);
  expect(await holes(stage)).toBe(0);
  await page.getByRole('button', { name: 'Colours', exact: true }).click();
  const button = page.getByRole('button', { name: 'Surfaces', exact: true });
  await expect(button).toHaveAttribute('aria-pressed', 'true');
  await button.click();
  await show(stage, 'depth-room');
  await expect(button).toHaveAttribute('aria-pressed', 'false');
  const points = await stage.probe();
  expect(points.surface).toBe(false);
  expect(points.points).toBeGreaterThan(5000);
  await button.click();
  await show(stage, 'depth-room');
  expect((await stage.probe()).surface).toBe(true);
});

test('lit colours: the floor, seen at a slant, is darker than what faces the eye; from above it is not', async ({
  stage,
}) => {
  const page = await stage.open({ state: 'still', query: { every: '1' }, stored: SURFACES_ALONE });
  await page.getByRole('button', { name: 'Colours', exact: true }).click();
  const mode = page.getByLabel('Colours of Cloud');
  const lightness = async (place: { right: number; down: number }) => {
    const [red, green, blue] = await stage.mean(await screenPlace(stage, place));
    return red + green + blue;
  };
  /** How much of the lightness of a wall and of the floor is left when they are lit. */
  const left = async () => {
    const seen: number[][] = [];
    for (const chosen of ['captured', 'lit']) {
      await mode.selectOption(chosen);
      await show(stage, 'depth-room', {}, 2);
      seen.push([await lightness({ right: 0.5, down: -0.1 }), await lightness({ right: 0.5, down: 0.5 })]);
    }
    const [captured = [], lit = []] = seen;
    return [(lit[0] ?? 0) / (captured[0] ?? 0), (lit[1] ?? 0) / (captured[1] ?? 0)] as const;
  };
  const [wall, floor] = await left();
  expect(wall).toBeGreaterThan(0.7);
  expect(wall).toBeLessThan(1.05);
  expect(floor).toBeLessThan(wall - 0.15);
  await expect(page.locator('.legend')).toContainText('lit from the eye');
  // Points have no normals, and the legend says so.
  await page.getByRole('button', { name: 'Surfaces', exact: true }).click();
  await show(stage, 'depth-room', {}, 2);
  await expect(page.locator('.legend')).toContainText('points, not lit');
});

test('lost packets leave no holes: what was seen there before stays', async ({ stage }) => {
  await stage.open({ state: 'still', query: { every: '1' }, stored: SURFACES });
  const packets = await show(stage, 'depth-room');
  expect(packets).toBeGreaterThan(5);
  const before = await stage.pixels();
  expect(await holes(stage)).toBe(0);
  for (let i = 0; i < packets; i += 3) {
    await show(stage, 'depth-room', { lose: [i, i + 1] }, 1);
    expect(await holes(stage), `without packets ${i} and ${i + 1}`).toBe(0);
  }
  expect(changedShare(before, await stage.pixels(), 24)).toBeLessThan(0.02);
  expect((await stage.stats()).packetsLost).toBeGreaterThan(0);
});

test('a camera and a LiDAR in one session: both drawn, each switched off and on without the other', async ({
  stage,
}) => {
  const page = await stage.open({ state: 'two-sensors', forMs: 1200 });
  const sensors = () => page.evaluate(() => window.farpoint.sensors());
  const drawn = async () => {
    await stage.run(1000);
    return (await sensors()).map(({ points }) => points > 0);
  };
  expect((await sensors()).map(({ name, wanted }) => [name, wanted])).toEqual([
    ['Camera', true],
    ['LiDAR', true],
  ]);
  expect(await drawn()).toEqual([true, true]);
  const lidar = page.getByRole('button', { name: 'LiDAR', exact: true });
  const camera = page.getByRole('button', { name: 'Camera', exact: true });
  await lidar.click();
  expect(await drawn()).toEqual([true, false]);
  expect((await stage.sent('sensors')).at(-1)?.sensors).toEqual([0]);
  await lidar.click();
  await camera.click();
  expect(await drawn()).toEqual([false, true]);
  expect((await stage.sent('sensors')).at(-1)?.sensors).toEqual([1]);
  await camera.click();
  expect(await drawn()).toEqual([true, true]);
});
