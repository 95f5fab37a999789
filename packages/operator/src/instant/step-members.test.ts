import { expect, test } from 'vitest';
import { stepMembers } from './step-members.ts';

const source = (name: string, delayMs: number, { inStep = false, isHeld = true } = {}) => ({
  ...{ name, delayMs, inStep, isHeld },
});
const names = (members: ReadonlySet<{ name: string }>) => [...members].map(({ name }) => name).join('');

test('the largest group within the width, and of equally large ones the earliest', () => {
  const [a, b, c, d] = [source('a', 10), source('b', 100), source('c', 120), source('d', 133)];
  expect(names(stepMembers([a, b, c, d], 33))).toBe('bcd');
  expect(names(stepMembers([a, b, c], 33))).toBe('bc');
  expect(names(stepMembers([b, a], 33))).toBe('a');
  expect(names(stepMembers([], 33))).toBe('');
});

test('a member stays a little beyond the width', () => {
  const a = source('a', 10);
  expect(names(stepMembers([a, source('b', 48)], 33))).toBe('a');
  expect(names(stepMembers([a, source('b', 48, { inStep: true })], 33))).toBe('ab');
  expect(names(stepMembers([a, source('b', 60, { inStep: true })], 33))).toBe('a');
});

test('what is not held belongs to a group only if it can make it wait', () => {
  const [a, b] = [source('a', 40), source('b', 70)];
  const cloud = (delayMs: number) => source('cloud', delayMs, { isHeld: false });
  expect(names(stepMembers([cloud(20), a, b], 33))).toBe('ab');
  expect(names(stepMembers([cloud(50), a, b], 33))).toBe('cloudab');
  expect(names(stepMembers([cloud(90), a, b], 33))).toBe('ab');
  expect(names(stepMembers([cloud(20)], 33))).toBe('');
});
