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

describe('how a base ramps sideways', () => {
  test('as forwards, unless told otherwise', () => {
    const { ramps } = toMotion(defaults, () => undefined);
    expect(Object.keys(ramps).filter((key) => key.startsWith('lateral'))).toEqual([]);
    const values = { ...defaults, lateralAccelerationMps2: 0.5, lateralDecelerationMps2: 3 };
    expect(toMotion(values, () => undefined).ramps).toMatchObject({
      ...{ lateralAccelerationMps2: 0.5, lateralDecelerationMps2: 3 },
    });
  });

  test('a weaker brake than that with which stopping distances are computed is refused', () => {
    expect(refusals({ lateralDecelerationMps2: 1.9 })).toEqual(['lateralDecelerationMps2']);
    expect(refusals({ lateralDecelerationMps2: 2 })).toEqual([]);
  });
});
