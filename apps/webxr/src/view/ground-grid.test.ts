import { expect, test } from 'vitest';
import { GroundGrid, gridSegments } from './ground-grid.ts';

test('draws every line end to end, in segments no longer than their distance from the eye or 1 m', () => {
  const ends = gridSegments();
  const lines = new Map<string, number[]>();
  for (let i = 0; i < ends.length; i += 4) {
    const [x0 = 0, z0 = 0, x1 = 0, z1 = 0] = ends.slice(i, i + 4);
    // A software renderer drops a longer segment completely if one of its ends is behind the camera.
    const far = Math.max(Math.min(Math.abs(x0), Math.abs(x1)), Math.min(Math.abs(z0), Math.abs(z1)));
    // The eye is up to half a step away from the grid's centre.
    expect(Math.hypot(x1 - x0, z1 - z0)).toBeLessThanOrEqual(Math.max(1, far - 2));
    const [line, from, to] = x0 === x1 ? [`x ${x0}`, z0, z1] : [`z ${z0}`, x0, x1];
    const known = lines.get(line) ?? [from];
    expect(known.at(-1)).toBe(from);
    lines.set(line, [...known, to]);
  }
  expect(ends.length / 4).toBeLessThan(410);
  // Every metre near the robot; far away every 4 m.
  for (const axis of ['x', 'z']) {
    for (let at = -8; at <= 8; at++) {
      const known = lines.get(`${axis} ${at}`) ?? [];
      expect([known[0], known.at(-1)]).toEqual(at % 4 === 0 ? [-20, 20] : at % 2 === 0 ? [-12, 12] : [-8, 8]);
    }
    for (let at = 9; at <= 20; at++)
      expect([at, lines.has(`${axis} ${at}`)]).toEqual([at, at % 4 === 0 || (at % 2 === 0 && at <= 12)]);
  }
});

test('follows in steps that put its lines on lines', () => {
  const grid = new GroundGrid();
  grid.centreOn(1.4, -2.6);
  expect([grid.object.position.x, grid.object.position.z]).toEqual([0, -4]);
});

test('approaches the ground’s height', () => {
  const grid = new GroundGrid();
  grid.approach(-1.8);
  expect(grid.object.position.y).toBeCloseTo(-0.91);
  for (let i = 0; i < 10; i++) grid.approach(-1.8);
  expect(grid.object.position.y).toBeCloseTo(-1.81);
});
