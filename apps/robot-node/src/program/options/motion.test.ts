import { describe, expect, test } from 'vitest';
import { guardOptions } from './guard.ts';
import { type MotionValues, motionOptions, toMotion } from './motion.ts';

const defaults = Object.fromEntries(
  Object.entries({ ...motionOptions, footprint: guardOptions.footprint }).map(([key, option]) => [
    key,
    option.default,
  ]),
) as unknown as MotionValues;

function refusals(changes: Partial<MotionValues>): string[] {
  const keys: string[] = [];
  toMotion({ ...defaults, ...changes }, (key) => keys.push(key));
  return keys;
}

describe('how the motion is bounded', () => {
  test('by default the view is required, and everything is bounded', () => {
    const { view, ramps } = toMotion(defaults, () => undefined);
    expect(view).toMatchObject({ slowMs: 250, brakeMs: 400, mostM: 0.5 });
    for (const rate of Object.values(ramps)) expect(rate).toBeGreaterThan(0);
  });

  test('a driver beside the robot needs no view', () => {
    expect(toMotion({ ...defaults, view: 'optional' }, () => undefined).view).toBe(null);
  });

  test('contradictions are refused by name', () => {
    expect(refusals({})).toEqual([]);
    expect(refusals({ viewSlowMs: 400 })).toEqual(['viewBrakeMs']);
    expect(refusals({ decelerationMps2: 5 })).toEqual(['emergencyMps2']);
  });
});
