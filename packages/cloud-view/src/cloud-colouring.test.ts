import { expect, test } from 'vitest';
import { freshnessAt } from './cloud-colouring.ts';

test('points are fresh for 600 ms, then fade for 1.4 s', () => {
  expect([0, 600, 1300, 2000, 60_000].map((ageMs) => freshnessAt(1e6 + ageMs, 1e6))).toEqual([
    1, 1, 0.5, 0, 0,
  ]);
  expect(freshnessAt(0, Number.NEGATIVE_INFINITY)).toBe(0);
});
