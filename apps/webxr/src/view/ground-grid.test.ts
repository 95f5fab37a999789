import { expect, test } from 'vitest';
import { GroundGrid, gridSegments } from './ground-grid.ts';

test('every line of the grid, in segments of a metre, each once', () => {
  const ends = gridSegments(3);
  const segments = Array.from({ length: ends.length / 4 }, (_, i) => ends.slice(i * 4, i * 4 + 4));
  // 7 lines of 6 segments, both ways.
  expect(new Set(segments.map(String)).size).toBe(2 * 7 * 6);
  expect(segments).toHaveLength(2 * 7 * 6);
  for (const [x0 = 0, z0 = 0, x1 = 0, z1 = 0] of segments) {
    // A longer one whose one end is behind the camera is not drawn at all by a software renderer.
    expect(Math.hypot(x1 - x0, z1 - z0)).toBe(1);
    expect(Math.max(...[x0, z0, x1, z1].map(Math.abs))).toBeLessThanOrEqual(3);
  }
});

test('moves along in whole metres', () => {
  const grid = new GroundGrid();
  grid.centreOn(1.4, -2.6);
  expect([grid.object.position.x, grid.object.position.z]).toEqual([1, -3]);
});
