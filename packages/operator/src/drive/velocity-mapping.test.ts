import { expect, test } from 'vitest';
import { toTwist } from './velocity-mapping.ts';

const limits = { maxLinear: 0.5, maxAngular: 1.5 };
const of = (forward: number, left: number) => {
  const { linear, angular } = toTwist({ forward, left }, limits);
  return [linear.x, angular.z];
};

test('a stick at its end asks for the fastest that is allowed', () => {
  expect(of(1, -1)).toEqual([0.5, -1.5]);
  expect(of(-0.5, 0.2)).toEqual([-0.25, expect.closeTo(0.3)]);
});

test('a stick that reports more than its end asks for no more', () => {
  expect(of(3, -1.01)).toEqual([0.5, -1.5]);
  expect(of(Number.NEGATIVE_INFINITY, 7)).toEqual([-0.5, 1.5]);
});

test('a stick that reports no number, or nothing, asks for rest', () => {
  expect(of(Number.NaN, Number.NaN)).toEqual([0, 0]);
  expect(of(-0, -0)).toEqual([0, 0]);
});
