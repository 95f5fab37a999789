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

const aside = (forward: number, sideways: number, left = 0) => {
  const { linear, angular } = toTwist({ forward, left, sideways }, { ...limits, maxLateral: 0.2 });
  return [linear.x, linear.y, angular.z];
};

test('sideways is scaled to its own limit, and asks nothing of a robot without one', () => {
  expect(aside(0, 1)).toEqual([0, 0.2, 0]);
  expect(aside(0, -3)).toEqual([0, -0.2, 0]);
  expect(aside(0, Number.NaN)).toEqual([0, 0, 0]);
  const { linear } = toTwist({ forward: 0, left: 0, sideways: -1 }, limits);
  expect(Object.is(linear.y, 0)).toBe(true);
});

test('both at once ask for no more than the greater limit, on the same arc', () => {
  const [x = 0, y = 0, z = 0] = aside(1, 1, 1);
  expect(Math.hypot(x, y)).toBeCloseTo(0.5);
  expect([y / x, z / x]).toEqual([expect.closeTo(0.4), expect.closeTo(3)]);
});
