import { expect, test } from 'vitest';
import { displayNameSchema, handleSchema, robotIdSchema, tokenSchema, uint32Schema } from './identifiers.ts';

test.each<[string, boolean]>([
  ['sim-1', true],
  ['0', true],
  ['a.b_c-d', true],
  ['x'.repeat(64), true],
  ['x'.repeat(65), false],
  ['', false],
  ['.hidden', false],
  ['..', false],
  ['a/b', false],
  ['Sim', false],
  ['a\n', false],
  ['robotér', false],
])('robot id %j: %s', (id, good) => {
  expect(robotIdSchema.safeParse(id).success).toBe(good);
});

test.each<[string, boolean]>([
  ['Ünal’s robot 🤖', true],
  ['', false],
  ['a\u0000b', false],
  ['a\u0085b', false],
  ['a\u001b[31m', false],
  ['x'.repeat(65), false],
])('display name %j: %s', (name, good) => {
  expect(displayNameSchema.safeParse(name).success).toBe(good);
});

test.each<[string, boolean]>([
  ['AZaz09_-', true],
  ['x'.repeat(64), true],
  ['x'.repeat(65), false],
  ['', false],
  ['a b', false],
  ['a\n', false],
  ['ä', false],
])('handle %j: %s', (handle, good) => {
  expect(handleSchema.safeParse(handle).success).toBe(good);
});

test('tokens and 32-bit numbers are bounded', () => {
  expect(tokenSchema.safeParse('x'.repeat(4096)).success).toBe(true);
  expect(tokenSchema.safeParse('x'.repeat(4097)).success).toBe(false);
  expect([0, 0xffffffff].every((n) => uint32Schema.safeParse(n).success)).toBe(true);
  expect([-1, 2 ** 32, 0.5, '1'].some((n) => uint32Schema.safeParse(n).success)).toBe(false);
});
