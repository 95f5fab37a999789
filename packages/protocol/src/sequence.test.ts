import { expect, test } from 'vitest';
import { nextSequence32, sequence32Of, sequenceDelta32 } from './sequence.ts';

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

test.each([
  [0, 1],
  [0x7fffffff, 0x80000000],
  [0xfffffffe, 0xffffffff],
  [0xffffffff, 0],
])('%i is followed by %i', (sequence, next) => {
  expect(nextSequence32(sequence)).toBe(next);
  expect(sequenceDelta32(next, sequence)).toBe(1);
});

test('a count that does not wrap, on a counter that does', () => {
  expect([0, 0xffffffff, 2 ** 32, 2 ** 33 + 5].map(sequence32Of)).toEqual([0, 0xffffffff, 0, 5]);
});
