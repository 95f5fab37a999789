import { expect, test } from 'vitest';
import { defaultDriveLimits, driveLimitsSchema } from './limits.ts';

test('the defaults are those of the documentation, and frozen', () => {
  expect(defaultDriveLimits).toEqual({
    maxLinear: 1,
    maxAngular: 1.5,
    watchdogMs: 150,
    maxCommandsPerSecond: 100,
  });
  expect(Object.isFrozen(defaultDriveLimits)).toBe(true);
});

test('an omitted field takes its default', () => {
  expect(driveLimitsSchema.parse({ maxLinear: 0.5 })).toEqual({ ...defaultDriveLimits, maxLinear: 0.5 });
});

test.each([
  [{ watchdogMs: 49 }, 'watchdogMs'],
  [{ watchdogMs: 1001 }, 'watchdogMs'],
  [{ maxLinear: 0 }, 'maxLinear'],
  [{ maxLinear: 11 }, 'maxLinear'],
  [{ maxAngular: Number.NaN }, 'maxAngular'],
  [{ maxAngular: Number.POSITIVE_INFINITY }, 'maxAngular'],
  [{ maxCommandsPerSecond: 9 }, 'maxCommandsPerSecond'],
  [{ maxLinear: '1' }, 'maxLinear'],
])('refuses %j', (input, field) => {
  const parsed = driveLimitsSchema.safeParse(input);
  expect(parsed.error?.issues[0]?.path).toEqual([field]);
});

test('refuses an unknown field: a misspelt limit must not pass unnoticed', () => {
  expect(driveLimitsSchema.safeParse({ maxLinaer: 0.2 }).success).toBe(false);
});
