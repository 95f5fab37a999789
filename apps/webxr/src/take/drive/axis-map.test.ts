import fc from 'fast-check';
import { expect, test } from 'vitest';
import { type AxisMap, deflection, isAtRest, mustRestFirst, shapedDeflection } from './axis-map.ts';

const stick: AxisMap = { axis: 0, centre: 0, least: -1, most: 1, inverted: false, deadZone: 0.1 };

test('an axis that rests off its middle and does not reach its ends goes from −1 to 1', () => {
  const worn = { ...stick, centre: 0.1, least: -0.8, most: 0.9 };
  expect([-0.8, 0.1, 0.9].map((value) => deflection(value, worn))).toEqual([-1, 0, 1]);
  expect(deflection(-0.35, worn)).toBeCloseTo(-0.5);
  expect(deflection(-0.8, { ...worn, inverted: true })).toBe(1);
  expect(shapedDeflection(0.15, worn)).toBe(0);
});

test('a pedal that rests at an end goes from 0 to 1', () => {
  const pedal = { ...stick, centre: 1, inverted: true };
  expect([1, 0, -1].map((value) => deflection(value, pedal) + 0)).toEqual([0, 0.5, 1]);
  expect([pedal, { ...pedal, centre: -0.26 }].map(mustRestFirst)).toEqual([true, true]);
  expect([stick, { ...stick, centre: 0.24 }].map(mustRestFirst)).toEqual([false, false]);
  // What browsers report of a pedal that nobody has touched.
  expect([
    isAtRest(0, pedal),
    isAtRest(0.86, pedal),
    isAtRest(0.84, pedal),
    isAtRest(Number.NaN, pedal),
  ]).toEqual([...[false, true, false, false]]);
});

test('noise of an axis that hardly moved when it was measured is no deflection', () => {
  expect(deflection(0.02, { ...stick, least: -0.14, most: 0.14 })).toBe(0);
  expect(deflection(0.08, { ...stick, least: -0.16, most: 0.16 })).toBe(0.5);
});

test('whatever an axis reads and however it was measured, the result is between −1 and 1', () => {
  const level = fc.double({ min: -1, max: 1, noNaN: true });
  const map = fc.record({
    ...{ axis: fc.nat(63), centre: level, least: level, most: level, inverted: fc.boolean() },
    deadZone: fc.double({ min: 0.02, max: 0.6, noNaN: true }),
  });
  fc.assert(
    fc.property(fc.oneof(fc.double(), fc.constantFrom(null, undefined)), map, (value, map) => {
      for (const made of [deflection(value, map), shapedDeflection(value, map)])
        expect(Math.abs(made)).toBeLessThanOrEqual(1);
    }),
    { seed: 11, numRuns: 2000 },
  );
});
