/** Commands for a base that goes sideways, from the gate to the guard. */
import { type Twist, zeroTwist } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { cutToLimits, outOfRange } from './command-range.ts';
import { defaultDriveLimits, driveLimitsSchema } from './limits.ts';
import { drivenGuard } from './testing/driven-guard.ts';

const LIMITS = { ...defaultDriveLimits, maxLateral: 0.5 };

function go(x: number, y: number, z = 0): Twist {
  const twist = zeroTwist();
  [twist.linear.x, twist.linear.y, twist.angular.z] = [x, y, z];
  return twist;
}

describe('the limit sideways', () => {
  test.each([[0], [0.5], [10]])('%s m/s is one', (maxLateral) => {
    expect(driveLimitsSchema.parse({ maxLateral })).toEqual({ ...defaultDriveLimits, maxLateral });
  });

  test.each([[-0.1], [10.1], [Number.NaN], [Number.POSITIVE_INFINITY], ['1']])('%s is none', (maxLateral) => {
    const parsed = driveLimitsSchema.safeParse({ maxLateral });
    expect(parsed.error?.issues[0]?.path).toEqual(['maxLateral']);
  });
});

describe('a command to the side', () => {
  test.each([
    ['left out', defaultDriveLimits],
    ['0', { ...defaultDriveLimits, maxLateral: 0 }],
  ])('is refused by a robot whose limit is %s, as an axis that it does not have', (_, limits) => {
    const { guard, send } = drivenGuard({ limits });
    for (const y of [1e-9, -0.2, Number.NaN]) {
      expect(send(0, 0.5, { twist: go(0.5, y) })).toMatchObject({
        reason: 'out-of-range',
        detail: expect.stringMatching(/^twist\.linear\.y .*: the robot has no such axis$/),
      });
    }
    expect(guard.velocityAt(0)).toEqual(zeroTwist());
  });

  test('moves a robot that can', () => {
    const { guard, send } = drivenGuard({ limits: LIMITS });
    expect(send(0, 0, { twist: go(0.1, -0.5, 0.2) })).toMatchObject({ twist: go(0.1, -0.5, 0.2) });
    expect(guard.velocityAt(10)).toEqual(go(0.1, -0.5, 0.2));
  });

  test.each([[0.51], [-0.6], [Number.NaN], [Number.POSITIVE_INFINITY]])(
    'is refused beyond its limit: %s m/s',
    (y) => {
      const { send } = drivenGuard({ limits: LIMITS });
      const verdict = send(0, 0, { twist: go(0, y) });
      expect(verdict).toMatchObject({
        reason: 'out-of-range',
        detail: expect.stringContaining('beyond ±0.5 m/s'),
      });
    },
  );

  test('is cut to the limit where a round trip has added to it', () => {
    expect(cutToLimits(go(0, 0.5000001), LIMITS)).toEqual(go(0, 0.5));
  });

  test('with as much forwards is cut to the greater limit, on the same arc', () => {
    const cut = cutToLimits(go(1, 0.5, 1), LIMITS);
    expect(Math.hypot(cut.linear.x, cut.linear.y)).toBeCloseTo(1);
    expect(cut.linear.y / cut.linear.x).toBeCloseTo(0.5);
    expect(cut.angular.z / cut.linear.x).toBeCloseTo(1);
  });
});

const part = fc.oneof(
  fc.constantFrom(0, 0.5, -0.5, 0.50000001, 1, -1, 1.0000001, 1e9, Number.NaN, Number.NEGATIVE_INFINITY),
  fc.double({ min: -2, max: 2, noNaN: true }),
);

test('whatever is asked for, what is let through is within every limit, and on the arc that was asked for', () => {
  let passed = 0;
  const speed = fc.constantFrom(0, 0.3, 0.5, 2);
  fc.assert(
    fc.property(part, part, part, speed, (x, y, z, maxLateral) => {
      const limits = { ...defaultDriveLimits, maxLateral };
      const asked = go(x, y, z);
      if (outOfRange(asked, limits) !== null) return;
      passed++;
      const { linear, angular } = cutToLimits(asked, limits);
      expect(Math.abs(linear.y)).toBeLessThanOrEqual(maxLateral);
      expect(Math.abs(linear.x)).toBeLessThanOrEqual(limits.maxLinear);
      expect(Math.abs(angular.z)).toBeLessThanOrEqual(limits.maxAngular);
      expect(Math.hypot(linear.x, linear.y)).toBeLessThanOrEqual(
        Math.max(limits.maxLinear, maxLateral) + 1e-12,
      );
      expect(linear.x * y).toBeCloseTo(linear.y * x, 5);
      expect(linear.x * z).toBeCloseTo(angular.z * x, 5);
    }),
    { seed: 5, numRuns: 2000 },
  );
  expect(passed).toBeGreaterThan(300);
});
