import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { type Scan, ScanGrid } from './scan-grid.ts';
import { floorClasses } from './sensor-grid.ts';

const SIDE = 160;
const CELL = 0.05;
const { free, occupied, unknown } = floorClasses;
const AHEAD = { x: 0, y: 0, z: 0, w: 1 };

function gridAt(x = 0, y = 0, z = 0.3, orientation = AHEAD): ScanGrid {
  const mount = { position: { x, y, z }, orientation };
  return new ScanGrid({ side: SIDE, cellM: CELL, mount, clearanceM: 0.04, heightM: 1.1 });
}

/** Every half degree, all around; what one ray measures. */
function scanOf(range: (angle: number) => number): Scan {
  const angleIncrement = Math.PI / 360;
  const ranges = Float32Array.from({ length: 720 }, (_, i) => range(-Math.PI + i * angleIncrement));
  return { angleMin: -Math.PI, angleIncrement, rangeMin: 0.1, rangeMax: 8, ranges };
}

function classAt({ classes }: ScanGrid, x: number, y: number): number | undefined {
  return classes[Math.floor(y / CELL + SIDE / 2) * SIDE + Math.floor(x / CELL + SIDE / 2)];
}

const HERE = { x: 0, y: 0, yaw: 0 };
const INF = Number.POSITIVE_INFINITY;

describe('a scan', () => {
  test('shows what it hits, and that nothing stands before it', () => {
    const grid = gridAt();
    expect(
      grid.look(
        scanOf(() => 2.02),
        HERE,
      ),
    ).toBe(720);
    for (const [x, y] of [
      [2.02, 0],
      [0, 2.02],
      [-2.02, 0],
      [1.43, -1.43],
    ] as const) {
      expect(classAt(grid, x, y)).toBe(occupied);
      expect(classAt(grid, 0.8 * x, 0.8 * y)).toBe(free);
      expect(classAt(grid, 1.1 * x, 1.1 * y)).toBe(unknown);
    }
  });

  test('is read as REP 117 says', () => {
    const grid = gridAt();
    const ahead = (range: number) => {
      const valid = grid.look(
        scanOf((angle) => (Math.abs(angle) < 0.5 ? range : Number.NaN)),
        HERE,
      );
      return [valid > 0, classAt(grid, 0.12, 0), classAt(grid, 1, 0), classAt(grid, 3.9, 0)];
    };
    expect(ahead(INF)).toEqual([true, free, free, free]);
    expect(ahead(-INF)).toEqual([true, occupied, unknown, unknown]);
    expect(ahead(Number.NaN)).toEqual([false, unknown, unknown, unknown]);
    // Out of range: no measurement.
    for (const range of [0, 0.05, -1, 8.1]) {
      expect(ahead(range)).toEqual([false, unknown, unknown, unknown]);
    }
  });

  test('is seen from where the scanner sits, and from where base_link was', () => {
    const left = { x: 0, y: 0, z: Math.SQRT1_2, w: Math.SQRT1_2 };
    const grid = gridAt(0.52, 0.12, 0.3, left);
    const ahead = scanOf((angle) => (Math.abs(angle) < 0.05 ? 1 : INF));
    grid.look(ahead, HERE);
    expect(classAt(grid, 0.52, 1.12)).toBe(occupied);
    grid.look(ahead, { x: 1, y: 0.5, yaw: Math.PI });
    expect(classAt(grid, 0.48, -0.62)).toBe(occupied);
    // Upside down, it turns the other way.
    const upsideDown = gridAt(0, 0, 0.3, { x: 1, y: 0, z: 0, w: 0 });
    upsideDown.look(
      scanOf((angle) => (Math.abs(angle - 1) < 0.05 ? 1 : INF)),
      HERE,
    );
    expect(classAt(upsideDown, Math.cos(1), -Math.sin(1))).toBe(occupied);
  });

  test('of a robot that moves is straightened', () => {
    const grid = gridAt();
    // A wall at x = 2; half a turn takes the robot 0.4 m nearer.
    const scan = scanOf((angle) => {
      const x = 0.4 * ((angle + Math.PI) / (2 * Math.PI));
      return Math.abs(angle) < 1 ? (2.02 - x) / Math.cos(angle) : INF;
    });
    grid.look(scan, HERE, { x: 0.4, y: 0, yaw: 0 });
    for (const y of [-1.5, -0.7, 0, 0.7, 1.5]) {
      expect(classAt(grid, 2.02, y)).toBe(occupied);
      expect(classAt(grid, 1.93, y)).toBe(free);
    }
  });

  test('of a tilted scanner that meets the floor is no obstacle, and one over the robot shows nothing', () => {
    // Pitched down by 0.2 rad: the floor ahead is 1.5 m away.
    const tilted = gridAt(0, 0, 0.3, { x: 0, y: Math.sin(0.1), z: 0, w: Math.cos(0.1) });
    tilted.look(
      scanOf((angle) => (Math.cos(angle) > 0.1 ? 0.3 / Math.sin(0.2) / Math.cos(angle) : INF)),
      HERE,
    );
    expect(tilted.classes.includes(occupied)).toBe(false);
    expect(classAt(tilted, 1, 0)).toBe(free);
    expect(classAt(tilted, 1.4, 0)).toBe(unknown);
    const high = gridAt(0, 0, 1.3);
    high.look(
      scanOf(() => 1),
      HERE,
    );
    expect(high.classes.every((known) => known === unknown)).toBe(true);
  });

  test('with few rays takes away only what cannot stand between them', () => {
    const grid = gridAt();
    const angleIncrement = Math.PI / 90;
    const ranges = new Array<number>(180).fill(INF);
    grid.look({ angleMin: -Math.PI, angleIncrement, rangeMin: 0.1, rangeMax: 8, ranges }, HERE);
    expect([classAt(grid, 1.3, 0), classAt(grid, 1.6, 0)]).toEqual([free, unknown]);
  });

  test('whatever it measures, only what lies on a ray is marked, and every hit in the grid is', () => {
    const number = fc.oneof(
      fc.double({ min: 0.1, max: 8, noNaN: true }),
      fc.constantFrom(INF, -INF, Number.NaN, 0, -3, 1e9),
    );
    const pose = fc.record({
      x: fc.double({ min: 0, max: CELL, noNaN: true }),
      y: fc.double({ min: 0, max: CELL, noNaN: true }),
      yaw: fc.double({ min: -4, max: 4, noNaN: true }),
    });
    const cases = fc.record({
      ranges: fc.array(number, { minLength: 1, maxLength: 60 }),
      angleMin: fc.double({ min: -4, max: 4, noNaN: true }),
      angleIncrement: fc.double({ min: 0.001, max: 0.2, noNaN: true }),
      pose,
    });
    fc.assert(
      fc.property(cases, ({ ranges, angleMin, angleIncrement, pose: { x, y, yaw } }) => {
        const grid = gridAt();
        const scan = { angleMin, angleIncrement, rangeMin: 0.1, rangeMax: 8, ranges };
        const valid = grid.look(scan, { x, y, yaw });
        let hits = 0;
        ranges.forEach((range, i) => {
          const at = range === -INF ? 0.1 : range;
          if (!(at >= 0.1 && at <= 8)) return;
          const angle = yaw + angleMin + i * angleIncrement;
          const [hx, hy] = [x + at * Math.cos(angle), y + at * Math.sin(angle)];
          hits++;
          // A cell's border may be rounded either way.
          const near = [-1e-6, 1e-6].flatMap((a) => [-1e-6, 1e-6].map((b) => classAt(grid, hx + a, hy + b)));
          if (Math.abs(hx) < 3.99 && Math.abs(hy) < 3.99) expect(near).toContain(occupied);
        });
        expect(valid).toBe(hits + ranges.filter((range) => range === INF).length);
        const strange = grid.classes.findIndex((known, cell) => {
          if (known !== free) return known !== unknown && known !== occupied;
          const [cx, cy] = [
            ((cell % SIDE) - SIDE / 2 + 0.5) * CELL - x,
            (Math.floor(cell / SIDE) - SIDE / 2 + 0.5) * CELL - y,
          ];
          return !ranges.some((range, i) => {
            if (!(range >= 0.1)) return false;
            const angle = yaw + angleMin + i * angleIncrement;
            const along = cx * Math.cos(angle) + cy * Math.sin(angle);
            const beside = Math.abs(cy * Math.cos(angle) - cx * Math.sin(angle));
            return along > -CELL && along < Math.min(range, 8) + CELL && beside < CELL;
          });
        });
        expect(strange).toBe(-1);
      }),
      { seed: 21, numRuns: 150 },
    );
  });
});
