/** The remembered world: what was seen stays, is on the small map, and can be saved, loaded and forgotten. */
import { readFile } from 'node:fs/promises';
import type { Download, Page } from '@playwright/test';
import { expectNothingCovered } from '../src/stage/boxes.ts';
import { expect, test } from '../src/stage/page-test.ts';
import { screenPlace } from '../src/stage/places.ts';
import { FRAME_MS, type Rgb, type Stage } from '../src/stage/stage.ts';

const BACKGROUND: Rgb = [11, 15, 20];
/** Seen from above: what floor and wall cover behind a robot that has turned round. */
const BEHIND = { x: 0.33, y: 0.65, width: 0.34, height: 0.2 };
/** Brighter than the background and the grid. */
const DRAWN_LEVEL = 60;
/** In this time the robot could turn round by itself, ms: poses that it cannot have reached make the memory forget. */
const TURNING_MS = 4000;

function open(stage: Stage, canvas = '160x90', every = '1'): Promise<Page> {
  return stage.open({
    frameMs: FRAME_MS,
    state: 'still',
    canvas,
    query: { every },
    stored: { 'farpoint.clouds': { memory: true } },
  });
}

/** Time passes without a picture. */
async function pass(stage: Stage, ms: number): Promise<void> {
  await stage.freeze();
  await stage.run(ms);
  await stage.thaw();
}

/** The robot sees the room from where it is: often enough that what it sees counts as there. */
async function see(stage: Stage, times = 4): Promise<void> {
  for (let i = 0; i < times; i++) {
    await stage.cloud('depth-room');
    await pass(stage, 260);
  }
}

/** The robot turns in place. Nothing is seen meanwhile. */
async function turnTo(stage: Stage, yaw: number): Promise<void> {
  await pass(stage, TURNING_MS);
  await stage.script(({ robot }, yaw) => {
    robot.pose.yaw = yaw;
  }, yaw);
  await stage.run(100);
}

/** Share of what lies behind the robot, seen from above, in which something is drawn. */
async function drawnBehind(stage: Stage): Promise<number> {
  await stage.frames(3);
  const pixels = await stage.pixels(BEHIND);
  return pixels.filter(([red]) => red > DRAWN_LEVEL).length / pixels.length;
}

/** What a camera sees of the room, metres: ahead, to the left, up. */
const ROOM = [
  [1.67, 4],
  [-3.2, 3.2],
  [0, 3.4],
] as const;

const memoryButton = (page: Page) => page.getByRole('button', { name: 'Memory', exact: true });
const openPanel = (page: Page) => page.getByRole('button', { name: 'Colours', exact: true }).click();

test('what was seen stays where nothing is seen now, dimmer, until it is switched off', async ({ stage }) => {
  const page = await open(stage);
  await see(stage);
  const { remembered } = await stage.stats();
  expect(remembered?.points).toBeGreaterThan(5000);
  await expect(page.locator('#facts')).toContainText(/Remembered\s*up to 10 s old/);
  const wall = await screenPlace(stage, { right: 0.5, down: -0.1 });
  const box = await screenPlace(stage, { right: 0, down: 0.375 });
  const colours = async () => {
    await stage.frames(3);
    return [await stage.mean(wall), await stage.mean(box)] as const;
  };
  const [liveWall, liveBox] = await colours();

  // The robot looks away, and sees the same room there.
  await turnTo(stage, Math.PI);
  await see(stage, 1);
  await page.keyboard.press('t');
  expect(await drawnBehind(stage)).toBeGreaterThan(0.3);
  await page.keyboard.press('t');

  // It looks back, and all of the frame but its first packet is lost.
  await turnTo(stage, 0);
  const lose = Array.from({ length: 100 }, (_, i) => i + 1);
  expect(await stage.cloud('depth-room', { lose })).toBeGreaterThan(3);
  await stage.run(200);
  const [rememberedWall, rememberedBox] = await colours();
  for (const [i, level] of rememberedWall.entries()) {
    expect(level).toBeLessThan(0.7 * (liveWall[i] ?? 0));
    expect(level).toBeGreaterThan(0.5 * (liveWall[i] ?? 0));
  }
  expect(rememberedBox[0]).toBeLessThan(0.7 * liveBox[0]);
  expect(rememberedBox[0] - Math.max(rememberedBox[1], rememberedBox[2])).toBeGreaterThan(40);

  await openPanel(page);
  await expect(memoryButton(page)).toHaveAttribute('aria-pressed', 'true');
  await memoryButton(page).click();
  expect(await colours()).toEqual([BACKGROUND, BACKGROUND]);
  await memoryButton(page).click();
  expect((await colours())[1][0]).toBeCloseTo(rememberedBox[0], -1);
});

async function save(page: Page): Promise<{ name: string; file: Buffer }> {
  const downloading = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Save', exact: true }).click();
  const download: Download = await downloading;
  return { name: download.suggestedFilename(), file: await readFile(await download.path()) };
}

test('it is saved as PLY and as PCD, forgotten on reload and on demand, and loaded from either', async ({
  stage,
}) => {
  const page = await open(stage);
  const load = async (name: string, buffer: Buffer, words: string) => {
    await page
      .getByLabel('Point cloud to remember')
      .setInputFiles({ name, mimeType: 'application/octet-stream', buffer });
    await expect(page.locator('#notice')).toHaveText(words);
  };
  const lookAway = async () => {
    await turnTo(stage, Math.PI);
    await see(stage, 1);
    await page.keyboard.press('t');
  };
  await see(stage);
  const { points = 0 } = (await stage.stats()).remembered ?? {};
  const count = points.toLocaleString('en');
  await openPanel(page);
  const ply = await save(page);
  expect(ply.name).toMatch(/^farpoint-world-2026-01-01T[\d-]+\.ply$/);
  expect(ply.file.toString('latin1')).toMatch(
    new RegExp(`^ply\nformat binary_little_endian 1\\.0\n[^]*\nelement vertex ${points}\n`),
  );
  await page.getByLabel('Format of the file').selectOption('pcd-text');
  const pcd = await save(page);
  expect(pcd.name).toMatch(/\.pcd$/);
  expect(pcd.file.toString('latin1')).toMatch(
    new RegExp(`^# \\.PCD v0\\.7[^]*\nPOINTS ${points}\nDATA ascii\n`),
  );
  const rows = pcd.file.toString('latin1').split('DATA ascii\n')[1]?.trim().split('\n') ?? [];
  expect(rows).toHaveLength(points);
  // The room: from where the camera sees the floor to the wall, 3.2 m to each side, and up to the edge of the picture.
  for (const [axis, [min, max]] of ROOM.entries()) {
    const values = rows.map((row) => Number(row.split(' ')[axis]));
    expect(Math.abs(Math.min(...values) - min)).toBeLessThan(0.05);
    expect(Math.abs(Math.max(...values) - max)).toBeLessThan(0.05);
  }
  await lookAway();
  const whole = await drawnBehind(stage);
  expect(whole).toBeGreaterThan(0.3);

  await stage.reload();
  await lookAway();
  expect(await drawnBehind(stage)).toBe(0);
  await load('room.ply', ply.file, `${count} points loaded from room.ply`);
  expect(await drawnBehind(stage)).toBeCloseTo(whole, 1);
  await openPanel(page);
  await page.getByRole('button', { name: 'Forget', exact: true }).click();
  expect(await drawnBehind(stage)).toBe(0);
  await load('room.pcd', pcd.file, `${count} points loaded from room.pcd`);
  expect(await drawnBehind(stage)).toBeCloseTo(whole, 1);
  await page
    .getByLabel('Point cloud to remember')
    .setInputFiles({ name: 'not.ply', mimeType: 'application/octet-stream', buffer: Buffer.from('pcd') });
  await expect(page.locator('#notice')).toContainText('not.ply cannot be loaded');
});

const MAP_SIDE_M = 16;
const OPAQUE = 255;
const TRAIL: Rgb = [53, 201, 181];

/** A pixel of the small map. @param ahead and to the left of the robot, metres */
const mapAt = (page: Page, ahead: number, left: number) =>
  page.locator('#minimap-picture').evaluate(
    (canvas: HTMLCanvasElement, [ahead, left, side]) => {
      const place = (metres: number) => Math.floor(canvas.width * (0.5 - metres / side));
      return [...(canvas.getContext('2d')?.getImageData(place(left), place(ahead), 1, 1).data ?? [])];
    },
    [ahead, left, MAP_SIDE_M] as const,
  );
test('a small map shows what is remembered around the robot, its age, and the way driven; it covers nothing', async ({
  stage,
}) => {
  await stage.page.setViewportSize({ width: 1280, height: 720 });
  const page = await open(stage, '64x36', '4');
  const age = page.locator('#minimap-age');
  await expect(age).toHaveText('nothing yet');
  await see(stage);
  await stage.run(300);
  await expect(age).toHaveText('up to 10 s old');
  const opaque = async (places: (readonly [ahead: number, left: number])[]) => {
    const found = [];
    for (const [ahead, left] of places) found.push((await mapAt(page, ahead, left))[3] === OPAQUE);
    return found;
  };
  // The floor on both sides of the box, and what the camera does not see: beside it, below it, behind it.
  const floor = [
    [3, 1.2],
    [3, -1.2],
  ] as const;
  expect(await opaque([...floor, [3, 3.5], [1.3, 0], [-3, 1.2]])).toEqual([true, true, false, false, false]);
  await pass(stage, 10_000);
  await stage.run(800);
  await expect(age).toHaveText('up to 20 s old');

  // It drives two metres, and turns round: the heading is up, and the way that it came lies ahead.
  await stage.script(({ robot }) => {
    const timer = setInterval(() => {
      robot.pose.x += 0.1;
      if (robot.pose.x > 1.99) clearInterval(timer);
    }, 50);
  });
  await stage.run(1200);
  await turnTo(stage, Math.PI);
  await stage.run(400);
  expect(
    await opaque([
      [-1, 1.2],
      [-1, -1.2],
      [3, 1.2],
    ]),
  ).toEqual([true, true, false]);
  // The line is narrower than two pixels.
  const trail = await mapAt(page, 1.5, 0);
  expect(
    [...TRAIL, OPAQUE].every((level, i) => Math.abs(level - (trail[i] ?? 0)) < 30),
    `${trail}`,
  ).toBe(true);
  expect((await mapAt(page, 2.5, 0))[3]).toBe(0);

  const map = page.locator('#minimap');
  for (const [width, height] of [
    [360, 740],
    [1280, 720],
    [3840, 2160],
  ] as const) {
    await stage.resize(width, height);
    const seen = await expectNothingCovered(page, `${width} × ${height}`);
    expect(seen.includes('minimap'), `on ${width} × ${height}`).toBe(width > 1100);
  }
  await openPanel(page);
  await memoryButton(page).click();
  await stage.run(300);
  await expect(map).toBeHidden();
});
