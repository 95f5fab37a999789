import { zeroTwist } from '@farpoint/protocol';
import { expect, test } from 'vitest';
import { stands } from './standing.ts';

const robot = (phase: string, ramping: boolean, linear: number | null, angular = 0) => {
  const twist = zeroTwist();
  [twist.linear.x, twist.angular.z] = [linear ?? 0, angular];
  return stands({
    station: { motion: { decision: { phase, factor: 1, reasons: [] }, ramping } },
    odometry: { newest: linear === null ? null : { twist } },
  } as never);
};

test.each([
  ['standing', false, 0, 0, true],
  ['latched', false, 0, 0, true],
  ['held', false, 0.02, 0.05, true],
  ['standing', false, null, 0, true],
  ['standing', false, 0.021, 0, false],
  ['standing', false, -0.03, 0, false],
  ['standing', false, 0, 0.06, false],
  ['standing', true, 0, 0, false],
  ['driving', false, 0, 0, false],
  ['limited', false, 0, 0, false],
  ['braking', false, 0, 0, false],
])('%s, ramping %s, measured %s m/s and %s rad/s: stands %s', (phase, ramping, linear, angular, is) => {
  expect(robot(phase, ramping, linear, angular)).toBe(is);
});
