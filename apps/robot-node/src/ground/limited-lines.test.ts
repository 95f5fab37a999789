import { expect, it } from 'vitest';
import { LimitedLines } from './limited-lines.ts';

it('lets ten through at once, then one a second that says how many were left out', () => {
  const lines = new LimitedLines();
  expect(Array.from({ length: 12 }, () => lines.take(0))).toEqual([...Array(10).fill(0), null, null]);
  expect([lines.take(999), lines.take(1000), lines.take(1001), lines.take(2000)]).toEqual([null, 3, null, 1]);
});
