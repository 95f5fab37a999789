/** For any sequence of commands to any side, the velocity for the wheels of a base that goes sideways. */
import { isZeroTwist, stampUsOf, type Twist, zeroTwist } from '@farpoint/protocol';
import fc from 'fast-check';
import { expect, test } from 'vitest';
import { defaultDriveLimits } from '../limits.ts';
import { drivenGuard } from '../testing/driven-guard.ts';
import { BlindTravel, blindSpeedMps } from './blind-travel.ts';
import { FREE, type MotionBound, type MotionGuard } from './motion-guard.ts';
import { MotionSupervisor } from './motion-supervisor.ts';

const ramps = {
  accelerationMps2: 1,
  lateralAccelerationMps2: 2,
  decelerationMps2: 2,
  emergencyMps2: 4,
  turnRadps2: 3,
  emergencyTurnRadps2: 6,
};
const view = { mostM: 0.5, decelerationMps2: 2, radiusM: 0.25 };
const STEP_MS = 10;
const EPSILON = 1e-9;

class Sensed implements MotionGuard {
  says: MotionBound = FREE;
  bound(): MotionBound {
    return this.says;
  }
}

const speedOf = ({ linear }: Twist) => Math.hypot(linear.x, linear.y);

const hand = fc.record({
  x: fc.double({ min: -1, max: 1, noNaN: true }),
  y: fc.oneof(fc.constantFrom(0, 0, 0.6, -0.6), fc.double({ min: -1.5, max: 1.5, noNaN: true })),
  z: fc.constantFrom(0, 0, 1, -1.5),
  forMs: fc.integer({ min: 20, max: 600 }),
  grip: fc.constantFrom(true, true, true, true, false),
  /** Nothing comes through. */
  silent: fc.constantFrom(false, false, false, true),
  /** How much later than usual the commands come, ms. */
  lateMs: fc.constantFrom(0, 0, 0, 0, 300),
  viewAgeMs: fc.integer({ min: 0, max: 350 }),
  factor: fc.constantFrom(1, 1, 1, 0.5, 0),
  estop: fc.constantFrom(false, false, false, false, false, true),
});

test.each([0, 0.6, 1.5])('with a limit of %f m/s sideways, every rule holds', (maxLateral) => {
  let aside = 0;
  let stops = 0;
  fc.assert(
    fc.property(fc.array(hand, { minLength: 3, maxLength: 15 }), (hands) => {
      const { guard, send } = drivenGuard({
        limits: { ...defaultDriveLimits, maxLateral, maxCommandsPerSecond: 1000 },
      });
      const sensed = new Sensed();
      const motion = new MotionSupervisor(guard, {
        ramps,
        guards: [new BlindTravel(guard.view, view), sensed],
      });
      const most = Math.max(defaultDriveLimits.maxLinear, maxLateral);
      let now = 1000;
      let before = zeroTwist();
      send(now, 0, { deadMan: false });
      for (const { x, y, z, forMs, grip, silent, lateMs, viewAgeMs, factor, estop } of hands) {
        sensed.says =
          factor === 1
            ? FREE
            : { factor, reason: factor === 0 ? 'obstacle' : 'obstacle-near', urgent: factor === 0 };
        if (estop) guard.latchEstop('operator', 'a');
        else if (guard.estopState().latched) {
          guard.releaseEstop('a');
          send(now, 0, { deadMan: false });
        }
        for (const untilMs = now + forMs; now < untilMs; now += STEP_MS) {
          const twist: Twist = { linear: { x, y, z: 0 }, angular: { x: 0, y: 0, z } };
          const seenUs = stampUsOf(now - viewAgeMs);
          guard.sentViews.sent('a', now - viewAgeMs);
          if (!silent) send(now, 0, { twist, deadMan: grip, seenUs, timeMs: now - lateMs });
          const wish = guard.velocityAt(now);
          const after = motion.velocityAt(now);
          const { linear, angular } = after;
          if (linear.y !== 0) aside++;

          expect(Math.abs(linear.y)).toBeLessThanOrEqual(maxLateral);
          expect(speedOf(after)).toBeLessThanOrEqual(most + EPSILON);
          expect([linear.z, angular.x, angular.y]).toEqual([0, 0, 0]);
          // Never faster than what the guard lets through of the wish, unless it comes from there.
          const bound = factor * speedOf(wish);
          expect(speedOf(after)).toBeLessThanOrEqual(Math.max(speedOf(before), bound) + EPSILON);
          const worstMs = guard.view.worstAgeMs(now);
          if (worstMs !== null && speedOf(after) > speedOf(before) + EPSILON)
            expect(speedOf(after)).toBeLessThanOrEqual(blindSpeedMps(worstMs, view) + EPSILON);
          // Whatever demands a stop: the speed falls at least as fast as forwards, and y stands no later than x.
          if (isZeroTwist(wish) || factor === 0) {
            if (speedOf(before) > 0) stops++;
            const fallen = Math.max(0, speedOf(before) - ramps.decelerationMps2 * (STEP_MS / 1000));
            expect(speedOf(after)).toBeLessThanOrEqual(fallen + EPSILON);
            if (Math.abs(before.linear.x) > EPSILON && linear.x === 0) expect(linear.y).toBe(0);
          }
          before = after;
        }
      }
    }),
    { seed: 29, numRuns: 150 },
  );
  // Without these checks, the property would hold for a robot that never moves.
  expect(stops).toBeGreaterThan(50);
  if (maxLateral > 0) expect(aside).toBeGreaterThan(2000);
  else expect(aside).toBe(0);
});
