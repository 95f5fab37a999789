/** The planar velocity of a base that goes sideways as well. */
import { type Twist, zeroTwist } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { NO_RAMPS, VelocityRamp } from './velocity-ramp.ts';

const limits = {
  accelerationMps2: 1,
  lateralAccelerationMps2: 0.5,
  decelerationMps2: 2,
  lateralDecelerationMps2: 2.5,
  emergencyMps2: 4,
  turnRadps2: 3,
  emergencyTurnRadps2: 6,
};
const EPSILON = 1e-9;

function go(x: number, y: number, z = 0): Twist {
  const twist = zeroTwist();
  [twist.linear.x, twist.linear.y, twist.angular.z] = [x, y, z];
  return twist;
}

/** A ramp that has arrived at a velocity. */
function at(x: number, y: number, change: object = {}): VelocityRamp {
  const ramp = new VelocityRamp({ ...limits, ...change }, 150);
  for (let t = 0; t <= 5000; t += 10) ramp.step(go(x, y), false, t);
  expect(ramp.differs(go(x, y))).toBe(false);
  return ramp;
}

const speedOf = ({ linear }: Twist) => Math.hypot(linear.x, linear.y);

describe('the ramp sideways', () => {
  test('speeds up and slows down at rates of its own', () => {
    const ramp = new VelocityRamp(limits, 150);
    ramp.step(go(0, 1), false, 0);
    expect(ramp.step(go(0, 1), false, 100)).toEqual(go(0, expect.closeTo(0.05) as unknown as number));
    expect(at(0, 1).step(go(0, 0), false, 5100).linear.y).toBeCloseTo(0.75);
    expect(at(0, 1).step(go(0, 0), true, 5100).linear.y).toBeCloseTo(0.6);
  });

  test('without rates of its own, or with a weaker brake, it is as forwards', () => {
    const same = { lateralAccelerationMps2: undefined, lateralDecelerationMps2: undefined };
    expect(at(0, 1, same).step(go(0, 0), false, 5100).linear.y).toBeCloseTo(0.8);
    const weak = { lateralDecelerationMps2: 0.1 };
    expect(at(0, 1, weak).step(go(0, 0), false, 5100).linear.y).toBeCloseTo(0.8);
    const ramp = new VelocityRamp({ ...limits, ...same }, 150);
    ramp.step(go(0, 1), false, 0);
    expect(ramp.step(go(0, 1), false, 100).linear.y).toBeCloseTo(0.1);
  });

  test('a robot that brakes keeps its direction, and both axes stand at once', () => {
    const ramp = at(0.3, 0.4);
    for (let t = 5010; t <= 5300; t += 10) {
      const { linear } = ramp.step(go(0, 0), false, t);
      if (linear.x === 0 || linear.y === 0) {
        expect(linear).toEqual(zeroTwist().linear);
        expect(t).toBeLessThanOrEqual(5250);
        return;
      }
      expect(linear.y / linear.x).toBeCloseTo(4 / 3);
    }
    expect.fail('it does not stand');
  });

  test('what the driver takes back falls at once, however slowly the other axis rises', () => {
    const ramp = at(1, 0);
    expect(ramp.step(go(0, 1), false, 5100).linear).toMatchObject({
      x: expect.closeTo(0.8),
      y: expect.closeTo(0.05),
    });
  });

  test('what rises faster than the other axis falls makes the robot no faster than it was or is to be', () => {
    const ramp = at(1, 0, { lateralAccelerationMps2: 20 });
    const { linear } = ramp.step(go(0, 1), false, 5100);
    expect(linear.x).toBeCloseTo(0.8);
    expect(linear.y).toBeCloseTo(0.6);
    const other = at(0, 1, { accelerationMps2: 20 });
    expect(other.step(go(1, 0), false, 5100).linear).toMatchObject({
      x: expect.closeTo(Math.sqrt(1 - 0.75 ** 2)),
      y: expect.closeTo(0.75),
    });
  });

  test('the other direction begins at zero', () => {
    const ramp = at(0, 0.1);
    expect(ramp.step(go(0, -1), false, 5100).linear.y).toBe(0);
    expect(ramp.step(go(0, -1), false, 5200).linear.y).toBeCloseTo(-0.05);
  });

  test('a base that ramps by itself is told its target at once', () => {
    const ramp = new VelocityRamp(NO_RAMPS, 150);
    for (const target of [go(0.3, 0.4, 1), go(-1, 0.1), go(0.1, -0.9), go(0, 0)])
      expect(ramp.step(target, false, 0)).toEqual(target);
  });

  test('wheels that were told nothing have stopped sideways, too', () => {
    const ramp = at(0, 1);
    expect(ramp.stands).toBe(false);
    expect(ramp.step(go(0, 0), true, 5200)).toEqual(zeroTwist());
    expect(ramp.stands).toBe(true);
  });
});

describe('whatever is asked', () => {
  const signed = fc.double({ min: -2, max: 2, noNaN: true });
  const part = fc.oneof(fc.constantFrom(0, 0, 1e-3, -1e-3), signed);
  const step = fc.record({
    x: part,
    y: part,
    urgent: fc.boolean(),
    waitMs: fc.integer({ min: 0, max: 149 }),
  });
  const steps = fc.array(step, { minLength: 1, maxLength: 60 });

  test('no axis changes faster than its rates, nor is the robot faster than it was and than is asked', () => {
    fc.assert(
      fc.property(steps, (all) => {
        const ramp = new VelocityRamp(limits, 150);
        let now = 0;
        let before = ramp.step(zeroTwist(), false, now);
        for (const { x, y, urgent, waitMs } of all) {
          now += waitMs;
          const target = go(x, y);
          const after = ramp.step(target, urgent, now);
          const s = waitMs / 1000;
          for (const [axis, rise, fall] of [
            ['x', 1, urgent ? 4 : 2],
            ['y', 0.5, urgent ? 4 : 2.5],
          ] as const) {
            const [from, to] = [before.linear[axis], after.linear[axis]];
            const most = (Math.abs(to) > Math.abs(from) ? rise : fall) * s;
            expect(Math.abs(to - from)).toBeLessThanOrEqual(most + EPSILON);
            expect(to).toBeLessThanOrEqual(Math.max(from, target.linear[axis], 0) + EPSILON);
            expect(to).toBeGreaterThanOrEqual(Math.min(from, target.linear[axis], 0) - EPSILON);
          }
          expect(speedOf(after)).toBeLessThanOrEqual(Math.max(speedOf(before), speedOf(target)) + EPSILON);
          before = after;
        }
      }),
      { seed: 23, numRuns: 400 },
    );
  });

  test('a stop takes off the speed no more slowly than forwards, and no axis outlasts the other', () => {
    fc.assert(
      fc.property(steps, fc.boolean(), fc.integer({ min: 1, max: 100 }), (all, urgent, everyMs) => {
        const ramp = new VelocityRamp(limits, 150);
        let now = 0;
        let before = zeroTwist();
        for (const { x, y, waitMs } of all) {
          now += waitMs;
          before = ramp.step(go(x, y), false, now);
        }
        for (const endMs = now + 3000; !ramp.stands; ) {
          expect(now).toBeLessThan(endMs);
          now += everyMs;
          const after = ramp.step(zeroTwist(), urgent, now);
          const least = ((urgent ? 4 : 2) * everyMs) / 1000;
          expect(speedOf(after)).toBeLessThanOrEqual(Math.max(0, speedOf(before) - least) + EPSILON);
          if (Math.abs(before.linear.x) > EPSILON && after.linear.x === 0) expect(after.linear.y).toBe(0);
          before = after;
        }
      }),
      { seed: 24, numRuns: 400 },
    );
  });

  test('forwards alone it is as without sideways rates, to the last bit', () => {
    const { lateralAccelerationMps2: _, lateralDecelerationMps2: __, ...plain } = limits;
    fc.assert(
      fc.property(steps, (all) => {
        const [a, b] = [new VelocityRamp(limits, 150), new VelocityRamp(plain, 150)];
        let now = 0;
        for (const { x, y, urgent, waitMs } of all) {
          now += waitMs;
          expect(a.step(go(x, 0, y), urgent, now)).toEqual(b.step(go(x, 0, y), urgent, now));
        }
      }),
      { seed: 25, numRuns: 100 },
    );
  });
});
