import { type Twist, zeroTwist } from '@farpoint/protocol';
import fc from 'fast-check';
import { expect, test } from 'vitest';
import { NO_RAMPS, VelocityRamp } from './velocity-ramp.ts';

const limits = {
  accelerationMps2: 1,
  decelerationMps2: 2,
  emergencyMps2: 4,
  turnRadps2: 3,
  emergencyTurnRadps2: 6,
};
const twist = (x: number, z = 0): Twist => ({
  linear: { x, y: 0, z: 0 },
  angular: { x: 0, y: 0, z },
});

test('starts, slows down and stops at the configured rates', () => {
  const ramp = new VelocityRamp(limits, 150);
  expect(ramp.step(twist(1), false, 0)).toEqual(zeroTwist());
  expect(ramp.step(twist(1), false, 100).linear.x).toBeCloseTo(0.1);
  for (let t = 110; t <= 1100; t += 10) ramp.step(twist(1), false, t);
  expect(ramp.differs(twist(1))).toBe(false);
  expect(ramp.step(twist(0), false, 1200).linear.x).toBeCloseTo(0.8);
  expect(ramp.step(twist(0), true, 1250).linear.x).toBeCloseTo(0.6);
});

test('a change of direction stops at zero first', () => {
  const ramp = new VelocityRamp(limits, 1000);
  ramp.step(twist(0.1), false, 0);
  ramp.step(twist(0.1), false, 100);
  expect(ramp.step(twist(-1), false, 200).linear.x).toBe(0);
  expect(ramp.step(twist(-1), false, 300).linear.x).toBeCloseTo(-0.1);
});

test('wheels that were told nothing have stopped: the ramp begins at zero', () => {
  const ramp = new VelocityRamp(limits, 150);
  ramp.step(twist(1), false, 0);
  for (let t = 10; t <= 1000; t += 10) ramp.step(twist(1), false, t);
  expect(ramp.step(twist(0), true, 1151)).toEqual(zeroTwist());
});

test('without ramps the target is reached at once, also in the other direction', () => {
  const ramp = new VelocityRamp(NO_RAMPS, 150);
  expect(ramp.step(twist(1, -1), false, 0)).toEqual(twist(1, -1));
  expect(ramp.step(twist(-1, 1), false, 0)).toEqual(twist(-1, 1));
});

test('whatever is asked, and however the clock goes, no step is greater than the ramps allow', () => {
  const step = fc.record({
    x: fc.double({ min: -2, max: 2, noNaN: true }),
    z: fc.double({ min: -2, max: 2, noNaN: true }),
    urgent: fc.boolean(),
    waitMs: fc.integer({ min: -20, max: 149 }),
  });
  fc.assert(
    fc.property(fc.array(step, { maxLength: 80 }), (steps) => {
      const ramp = new VelocityRamp(limits, 150);
      let now = 0;
      let before = ramp.step(zeroTwist(), false, now);
      for (const { x, z, urgent, waitMs } of steps) {
        now += waitMs;
        const after = ramp.step(twist(x, z), urgent, now);
        const s = Math.max(0, waitMs) / 1000;
        const [from, to] = [before.linear.x, after.linear.x];
        const rises = Math.abs(to) > Math.abs(from);
        const most = (rises ? 1 : urgent ? 4 : 2) * s;
        expect(Math.abs(to - from)).toBeLessThanOrEqual(most + 1e-9);
        expect(Math.abs(after.angular.z - before.angular.z)).toBeLessThanOrEqual((urgent ? 6 : 3) * s + 1e-9);
        // Never beyond both where it was and where it is to go.
        expect(to).toBeLessThanOrEqual(Math.max(from, x, 0));
        expect(to).toBeGreaterThanOrEqual(Math.min(from, x, 0));
        before = after;
      }
    }),
    { seed: 19 },
  );
});
