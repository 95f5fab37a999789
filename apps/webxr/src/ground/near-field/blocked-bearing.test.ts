import type { MotionState, Twist } from '@farpoint/protocol';
import { expect, test } from 'vitest';
import { blockedBearing } from './blocked-bearing.ts';

const HELD: MotionState = { factor: 0, reasons: ['obstacle'], mostLinear: 1 };
const zero = { x: 0, y: 0, z: 0 };
const ask = (linear: number, angular = 0): Twist => ({
  linear: { ...zero, x: linear },
  angular: { ...zero, z: angular },
});

test('it is where the hand leads', () => {
  expect(blockedBearing(ask(0.5), HELD)).toBe(0);
  expect(Math.abs(blockedBearing(ask(-0.5), HELD) ?? 0)).toBe(Math.PI);
  expect(blockedBearing(ask(0, 1), HELD)).toBe(Math.PI / 2);
  expect(blockedBearing(ask(0, -1), HELD)).toBe(-Math.PI / 2);
  // On an arc to the left; and backwards on the arc that turns the robot to the left, which leads to its right.
  expect(blockedBearing(ask(1, 1), HELD)).toBeCloseTo(0.46, 2);
  expect(blockedBearing(ask(-1, 1), HELD)).toBeCloseTo(-2.68, 2);
});

test('only what stands in the way blocks, and only who drives', () => {
  expect(blockedBearing(null, HELD)).toBe(null);
  expect(blockedBearing(ask(0), HELD)).toBe(null);
  expect(blockedBearing(ask(1), undefined)).toBe(null);
  expect(blockedBearing(ask(1), { ...HELD, factor: 0.1 })).toBe(null);
  expect(blockedBearing(ask(1), { ...HELD, reasons: ['view-lost'] })).toBe(null);
  expect(blockedBearing(ask(1), { ...HELD, reasons: ['fence', 'view-late'] })).toBe(0);
});
