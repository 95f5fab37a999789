import { expect, it } from 'vitest';
import { LineLimit } from './line-limit.ts';

it('admits so many lines in a time, and says how many it has left out', () => {
  const limit = new LineLimit(2, 100);
  expect([0, 1, 2, 99].map((ms) => limit.admit(ms))).toEqual([0, 0, null, null]);
  expect([100, 101, 102].map((ms) => limit.admit(ms))).toEqual([2, 0, null]);
  expect(limit.admit(1000)).toBe(1);
  expect(limit.admit(2000)).toBe(0);
});
