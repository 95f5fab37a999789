import { expect, test } from 'vitest';
import { sequenceDelta32 } from './sequence.ts';

test.each([
  [1, 0, 1],
  [0, 1, -1],
  [0, 0xffffffff, 1],
  [0xffffffff, 0, -1],
  [0x7fffffff, 0, 0x7fffffff],
  [0x80000000, 0, -0x80000000],
])('%i against %i is %i', (a, b, delta) => {
  expect(sequenceDelta32(a, b)).toBe(delta);
});
