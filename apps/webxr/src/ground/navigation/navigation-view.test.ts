import { expect, test } from 'vitest';
import { mapView, pathView } from './navigation-view.ts';

const path = (
  ageMs: number | null,
  points = [
    [0, 0],
    [1, 0],
  ],
) => pathView({ points, topic: '/plan', ageMs: () => ageMs } as never, 0);
const map = (silentMs: number | null, ageMs = 3_600_000) => {
  const place = silentMs === null ? null : { width: 1, height: 1, cellM: 1, origin: { x: 0, y: 0, yaw: 0 } };
  const cells = new Uint8Array(1);
  return mapView({ place, cells, changes: 3, ageMs: () => ageMs, silentMs: () => silentMs } as never, 0);
};

test('a path is shown while it is fresh, told while it is old, and then it is nothing any more', () => {
  expect(path(null)).toBe(null);
  expect(path(4000)).toMatchObject({ stale: false, ageMs: 4000 });
  expect(path(5001)).toMatchObject({ stale: true });
  expect(path(60_001)).toBe(null);
  expect(path(100, [])).toBe(null);
  expect(path(100, [[0, 0]])).toBe(null);
});

test('a map may be old, but the robot must go on to tell it', () => {
  expect(map(null)).toBe(null);
  expect(map(4100)).toMatchObject({ stale: false, ageMs: 3_600_000, changes: 3 });
  expect(map(15_001)).toMatchObject({ stale: true, silentMs: 15_001 });
  expect(map(60_001)).toBe(null);
});
