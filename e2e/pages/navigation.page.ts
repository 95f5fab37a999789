/** What the robot's own navigator has planned and its map are on the floor, while they hold. */
import { MAP_TILE, tileCount, tileRuns } from '@farpoint/protocol';
import { expect, test } from '../src/stage/page-test.ts';
import { changedShare } from '../src/stage/pictures.ts';
import { FRAME_MS, type Stage } from '../src/stage/stage.ts';

/** Four metres ahead, then to the left. */
const PATH: [number, number][] = [
  [0.5, 0],
  [2, 0],
  [4, 0],
  [4, 2],
];
/** Cells of 0.1 m around the robot: free, with a wall along the far side; the last column is unknown. */
const MAP = { width: 2 * MAP_TILE, height: MAP_TILE };
const cells = Uint8Array.from({ length: MAP.width * MAP.height }, (_, i) => {
  const column = i % MAP.width;
  return column === MAP.width - 1 ? 0 : column === MAP.width - 2 ? 3 : 1;
});
const TILES = Array.from({ length: tileCount(MAP) }, (_, i): [number, string] => [
  i,
  tileRuns(MAP, i, cells),
]);
const KNOWN = (MAP.width - 1) * MAP.height;

async function tellNavigation(stage: Stage): Promise<void> {
  await stage.script(
    (stage, [points, map, tiles]) => {
      const timeMs = stage.robot.nowMs;
      stage.tell({ type: 'path', topic: '/plan', timeMs, ageMs: 0, points });
      // In words, they are readings of the same topics.
      const reading = { type: 'reading', level: 'ok', ageMs: 0, timeMs } as const;
      stage.tell(
        { ...reading, topic: '/plan', label: 'Path', values: [['', '5.5 m']] },
        { ...reading, topic: '/map', label: 'Map', values: [['', '6.4 × 3.2 m, cells of 0.1 m']] },
      );
      stage.tell({
        ...{ type: 'map', topic: '/map', number: 1, timeMs, ageMs: 0, ...map, cellM: 0.1 },
        ...{ origin: { x: -0.5, y: -1.6, yaw: 0 }, tiles },
      });
    },
    [PATH, MAP, TILES] as const,
  );
  await stage.run(400);
}

const shown = async (stage: Stage) => (await stage.state()).navigation;
const NOTHING = { pathPoints: 0, mapCells: 0 };

test('path and map are on the floor, can be hidden, and their sizes are told', async ({ stage }) => {
  const page = await stage.open({ frameMs: FRAME_MS });
  const facts = page.locator('#facts');
  expect(await shown(stage)).toEqual(NOTHING);
  await expect(facts).not.toContainText('Path');
  await page.keyboard.press('t');
  await stage.frames(20);
  await stage.script((stage) => stage.stream(null));
  const without = await stage.pixels();
  await tellNavigation(stage);
  expect((await shown(stage)).pathPoints).toBeGreaterThan(3);
  expect((await shown(stage)).mapCells).toBe(KNOWN);
  expect(changedShare(without, await stage.pixels())).toBeGreaterThan(0.01);
  await expect(facts).toContainText(/Path\s*5\.5 m/);
  await expect(facts).toContainText(/Map\s*6\.4 × 3\.2 m, cells of 0\.1 m, 0 s old/);
  await page.locator('#colours-open').click();
  const button = page.locator('#navigation');
  await expect(button).toHaveText('Drawn');
  await button.click();
  await stage.run(300);
  await expect(button).toHaveText('Not drawn');
  expect(await shown(stage)).toEqual(NOTHING);
  expect(changedShare(without, await stage.pixels())).toBe(0);
  await button.click();
  await stage.run(300);
  expect((await shown(stage)).mapCells).toBe(KNOWN);
});
