import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { type AxisModel, coast, standingAt, stepAxis, stepBase, usualBase } from './base-model.ts';

const axis: AxisModel = { gain: 1, lagS: 0.2, rise: 100, fall: 100 };

describe('an axis', () => {
  test('reaches 63 % of a step in one time constant, in one step or in many', () => {
    expect(stepAxis(0, 1, axis, 0.2)).toBeCloseTo(0.632, 3);
    let velocity = 0;
    for (let i = 0; i < 20; i++) velocity = stepAxis(velocity, 1, axis, 0.01);
    expect(velocity).toBeCloseTo(0.632, 3);
  });

  test('changes no faster than its acceleration allows, nor beyond its target', () => {
    const values = fc.double({ min: -2, max: 2, noNaN: true });
    const rates = fc.double({ min: 0.1, max: 5, noNaN: true });
    fc.assert(
      fc.property(values, values, rates, rates, (velocity, target, rise, fall) => {
        const next = stepAxis(velocity, target, { gain: 1, lagS: 0.01, rise, fall }, 0.01);
        expect(Math.abs(next - velocity)).toBeLessThanOrEqual(Math.max(rise, fall) * 0.01 + 1e-12);
        expect(Math.abs(target - next)).toBeLessThanOrEqual(Math.abs(target - velocity) + 1e-12);
      }),
      { seed: 1 },
    );
  });

  test('brakes at one rate and speeds up at another', () => {
    const slow: AxisModel = { gain: 1, lagS: 0.005, rise: 1, fall: 2 };
    expect(stepAxis(0.5, 1, slow, 0.1)).toBeCloseTo(0.6, 9);
    expect(stepAxis(0.5, 0, slow, 0.1)).toBeCloseTo(0.3, 9);
    expect(stepAxis(-0.5, 1, slow, 0.1)).toBeCloseTo(-0.3, 9);
  });
});

test('of a robot that is not identified, what it says of itself is believed, and little of the rest', () => {
  const told = usualBase(100, { accelerationMps2: 1.2, decelerationMps2: 2.5, turnRadps2: 3 });
  expect([told.linear.rise, told.linear.fall, told.angular.rise, told.angular.fall]).toEqual([
    1.2, 2.5, 3, 3,
  ]);
  const unknown = usualBase(100);
  expect(unknown.angular.rise).toBeLessThan(told.angular.rise);
  expect(unknown.angular.lagS).toBeGreaterThan(told.angular.lagS);
  // A robot of an earlier version tells only how it brakes.
  expect(usualBase(100, { decelerationMps2: 2 })).toEqual({
    ...unknown,
    linear: { ...unknown.linear, fall: 2 },
  });
});

test('a base with constant velocities drives on a circle', () => {
  const motion = { ...standingAt(), linear: 1, angular: 0.5 };
  const model = usualBase(0);
  for (let i = 0; i < 100; i++) stepBase(motion, model, 1, 0.5, 0.01);
  expect(motion.yaw).toBeCloseTo(0.5, 9);
  expect(motion.x).toBeCloseTo(Math.sin(0.5) / 0.5, 4);
  expect(motion.y).toBeCloseTo((1 - Math.cos(0.5)) / 0.5, 4);
});

test('coasting back undoes coasting on', () => {
  const motion = standingAt(1, 2, 3);
  coast(motion, 0.7, -0.4, 0.1);
  coast(motion, 0.7, -0.4, -0.1);
  expect([motion.x, motion.y, motion.yaw].map((value) => Math.round(value * 1e9) / 1e9)).toEqual([1, 2, 3]);
});

test('a base that goes sideways moves to its left, as fast as forwards it would', () => {
  const [aside, ahead] = [standingAt(0, 0, Math.PI / 2), standingAt()];
  const model = usualBase(0);
  for (let i = 0; i < 200; i++) {
    stepBase(aside, model, 0, 0, 0.01, 1);
    stepBase(ahead, model, 1, 0, 0.01);
  }
  expect(aside.lateral).toBeCloseTo(ahead.linear, 9);
  expect([aside.x, aside.y]).toEqual([expect.closeTo(-ahead.x, 9), expect.closeTo(0, 9)]);
  const back = standingAt(1, 2, 3);
  coast(back, 0.7, -0.4, 0.1, 0.5);
  coast(back, 0.7, -0.4, -0.1, 0.5);
  expect([back.x, back.y, back.yaw]).toEqual([expect.closeTo(1), expect.closeTo(2), expect.closeTo(3)]);
});
