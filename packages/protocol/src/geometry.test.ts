import { expect, test } from 'vitest';
import { isZeroTwist, poseSchema, quaternionSchema, zeroTwist } from './geometry.ts';

test('a zero twist requests no motion, whatever the sign of its zeros', () => {
  expect(isZeroTwist(zeroTwist())).toBe(true);
  expect(isZeroTwist({ linear: { x: -0, y: 0, z: 0 }, angular: { x: 0, y: 0, z: -0 } })).toBe(true);
});

test('any non-zero component is motion, and so is NaN', () => {
  for (const part of ['linear', 'angular'] as const) {
    for (const axis of ['x', 'y', 'z'] as const) {
      for (const value of [1e-300, -1, Number.NaN]) {
        const twist = zeroTwist();
        twist[part][axis] = value;
        expect(isZeroTwist(twist)).toBe(false);
      }
    }
  }
});

test('each call for a zero twist returns a new object', () => {
  zeroTwist().linear.x = 1;
  expect(zeroTwist().linear.x).toBe(0);
});

test.each([
  [{ x: 0, y: 0, z: 0, w: 1.0099 }, true],
  [{ x: 0, y: 0, z: 0, w: -0.9901 }, true],
  [{ x: 0, y: 0, z: 0, w: 1.0101 }, false],
  [{ x: 0, y: 0, z: 0, w: 0 }, false],
  [{ x: 0.5, y: 0.5, z: 0.5, w: 0.5 }, true],
  [{ x: 0.5, y: 0.5, z: 0.5, w: 0.5, v: 0 }, false],
])('quaternion %j: %s', (quaternion, good) => {
  expect(quaternionSchema.safeParse(quaternion).success).toBe(good);
});

test('a pose must be finite', () => {
  const orientation = { x: 0, y: 0, z: 0, w: 1 };
  expect(poseSchema.safeParse({ position: { x: 1, y: 2, z: 3 }, orientation }).success).toBe(true);
  expect(poseSchema.safeParse({ position: { x: 1, y: 2, z: Number.NaN }, orientation }).success).toBe(false);
});
