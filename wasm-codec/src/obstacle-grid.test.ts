import fc from 'fast-check';
import { beforeAll, describe, expect, test } from 'vitest';
import type { Codec } from './codec.ts';
import { loadCodecFromDisk } from './load-node.ts';
import { cellClasses, ObstacleGrid, type ObstacleGridSettings } from './obstacle-grid.ts';

let codec: Codec;
beforeAll(async () => {
  codec = await loadCodecFromDisk();
});

const SETTINGS: ObstacleGridSettings = {
  ...{ side: 160, cellM: 0.05, clearanceM: 0.04, heightM: 1.1, dropM: 0.15, slope: 0.01, lowRayM: 0.15 },
  ...{ nearPoints: 10, leastPoints: 2, confirm: false },
};
/** Optical axes (z forward, x right, y down) to REP-103, looking ahead; 0.9 m up. */
const AHEAD = [0, 0, 1, -1, 0, 0, 0, -1, 0, 0, 0, 0.9];
const CAMERA = { fx: 80, fy: 80, cx: 79.5, cy: 79.5 };

/** The floor, and a wall 2.52 m ahead. */
function fillRoom(grid: ObstacleGrid): void {
  const { depth } = grid;
  depth.forEach((_, pixel) => {
    const up = (CAMERA.cy - Math.floor(pixel / 160)) / CAMERA.fy;
    depth[pixel] = Math.min(up < 0 ? -0.9 / up : Number.POSITIVE_INFINITY, 2.52);
  });
}

function classAt(grid: ObstacleGrid, x: number, y: number): number | undefined {
  const cell = (v: number) => Math.floor(v / 0.05) + 80;
  return grid.classes[cell(y) * 160 + cell(x)];
}

test('judges an image: floor, wall, and what nobody sees', () => {
  using grid = new ObstacleGrid(codec, 160 * 160, SETTINGS);
  grid.setCamera({ width: 160, height: 160 }, CAMERA);
  fillRoom(grid);
  grid.pose.set(AHEAD);
  const seen = grid.look('image');
  expect(classAt(grid, 2.52, 0)).toBe(cellClasses.occupied);
  expect(classAt(grid, 1.5, 0.2)).toBe(cellClasses.free);
  expect(classAt(grid, 3, 0)).toBe(cellClasses.unknown);
  const count = (wanted: number) => grid.classes.reduce((sum, it) => sum + (it === wanted ? 1 : 0), 0);
  expect(seen).toEqual({ free: count(1), occupied: count(2), dropOffs: 0 });
});

test('judges points, and finds a missing floor', () => {
  using grid = new ObstacleGrid(codec, 100, SETTINGS);
  grid.pose.set(AHEAD);
  // 1 m below the floor: the rays pass through it at 2.5 · 0.9 / 1.9 m.
  for (let i = 0; i < 20; i++) grid.points.set([0, 1.9, 2.5, Number.NaN], i * 4);
  expect(grid.look({ points: 20 })).toEqual({ free: 0, occupied: 0, dropOffs: 1 });
  expect(classAt(grid, (2.5 * 0.9) / 1.9, 0)).toBe(cellClasses.dropOff);
  expect(grid.look({ points: 0 })).toEqual({ free: 0, occupied: 0, dropOffs: 0 });
});

describe('refuses', () => {
  test.each([
    ['a side that is not whole', { side: 10.5 }],
    ['an odd side', { side: 11 }],
    ['no cell', { cellM: 0 }],
    ['a band without height', { heightM: 0.01 }],
    ['NaN', { dropM: Number.NaN }],
  ])('%s', (_, bad) => {
    expect(() => new ObstacleGrid(codec, 10, { ...SETTINGS, ...bad })).toThrow(
      expect.objectContaining({ code: 'bad-parameter' }),
    );
  });

  test('more points than its capacity, a pose that is none, an image without a camera', () => {
    using grid = new ObstacleGrid(codec, 10, SETTINGS);
    expect(() => grid.look({ points: 1 })).toThrow('the pose is none');
    grid.pose.set(AHEAD);
    expect(() => grid.look({ points: 11 })).toThrow(expect.objectContaining({ code: 'too-many-points' }));
    expect(() => grid.look({ points: 1.5 })).toThrow(expect.objectContaining({ code: 'bad-count' }));
    expect(() => grid.look('image')).toThrow('no camera has been set');
    expect(() => grid.setCamera({ width: 4, height: 3 }, CAMERA)).toThrow('no camera of 4 × 3');
    expect(grid.look({ points: 10 })).toEqual({ free: 0, occupied: 0, dropOffs: 0 });
  });
});

test('takes any numbers', () => {
  using grid = new ObstacleGrid(codec, 64, { ...SETTINGS, side: 20, confirm: true });
  grid.pose.set(AHEAD);
  const numbers = fc.array(fc.float({ noDefaultInfinity: false, noNaN: false }), { maxLength: 256 });
  fc.assert(
    fc.property(numbers, fc.integer(), fc.integer(), (cloud, dx, dy) => {
      grid.points.fill(0).set(cloud);
      const { free, occupied, dropOffs } = grid.look({ points: 64 }, [dx, dy]);
      expect(free + occupied + dropOffs).toBeLessThanOrEqual(400);
      expect(grid.classes.every((it) => it <= 3)).toBe(true);
    }),
    { seed: 3 },
  );
});
