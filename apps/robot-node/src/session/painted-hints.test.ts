import { expect, it } from 'vitest';
import { PaintedHints } from './painted-hints.ts';

it('goes by what was said last, for 3 s', () => {
  const hints = new PaintedHints();
  expect(hints.has(0, 0)).toBe(false);
  hints.take([0, 2], 1000);
  expect([0, 1, 2].map((sensor) => hints.has(sensor, 3999))).toEqual([true, false, true]);
  expect(hints.has(0, 4000)).toBe(false);
  hints.take([0], 4000);
  hints.take([], 4100);
  expect(hints.has(0, 4100)).toBe(false);
});
