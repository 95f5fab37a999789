import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { type CloudClaim, cloudShare, probingSensor } from './cloud-shares.ts';

const M = 1e6;
const claim = (usefulBitsPerSecond: number, weight = 1, priority = 0): CloudClaim => ({
  usefulBitsPerSecond,
  weight,
  priority,
});

describe('cloudShare', () => {
  it('gives everything to a single sensor, even more than it was known to use', () => {
    expect(cloudShare(0, 40 * M, [claim(10 * M), claim(10 * M)], new Set([0]))).toBe(40 * M);
  });

  it('gives nothing to a sensor that is not wanted or does not exist', () => {
    expect(cloudShare(1, 40 * M, [claim(10 * M), claim(10 * M)], new Set([0]))).toBe(0);
    expect(cloudShare(5, 40 * M, [claim(10 * M)], new Set([0, 5]))).toBe(0);
  });

  it('gives the share of a sensor that can no longer use anything to the others', () => {
    const claims = [claim(Number.POSITIVE_INFINITY), claim(0)];
    expect([0, 1].map((sensor) => cloudShare(sensor, 40 * M, claims, new Set([0, 1])))).toEqual([40 * M, 0]);
  });

  it('gives each sensor as much as it can use if there is enough', () => {
    const claims = [claim(30 * M, 3), claim(6 * M)];
    expect([0, 1].map((sensor) => cloudShare(sensor, 50 * M, claims, new Set([0, 1])))).toEqual([
      30 * M,
      6 * M,
    ]);
  });

  it('shares by priority, then by weight, if there is not enough', () => {
    const wanted = new Set([0, 1]);
    const byWeight = [claim(Number.POSITIVE_INFINITY, 3), claim(Number.POSITIVE_INFINITY)];
    expect(cloudShare(0, 9 * M, byWeight, wanted)).toBe(0.5 * M + 8 * M * 0.75);
    const byPriority = [claim(30 * M, 1, 0), claim(30 * M, 1, 1)];
    expect(cloudShare(0, 9 * M, byPriority, wanted)).toBe(8.5 * M);
    expect(cloudShare(1, 9 * M, byPriority, wanted)).toBe(0.5 * M);
  });

  it('never gives more than there is', () => {
    const claims = fc.array(
      fc.record({
        priority: fc.nat(2),
        weight: fc.integer({ min: 1, max: 9 }),
        usefulBitsPerSecond: fc.oneof(
          fc.integer({ min: 0, max: 1e8 }),
          fc.constant(Number.POSITIVE_INFINITY),
        ),
      }),
      { minLength: 1, maxLength: 8 },
    );
    fc.assert(
      fc.property(claims, fc.nat(1e8), (given, total) => {
        const wanted = new Set(given.keys());
        const shares = given.map((_, sensor) => cloudShare(sensor, total, given, wanted));
        expect(shares.reduce((sum, share) => sum + share, 0)).toBeLessThanOrEqual(total * (1 + 1e-9) + 1e-6);
      }),
      { seed: 21 },
    );
  });
});

describe('probingSensor', () => {
  const claims = [claim(Number.POSITIVE_INFINITY, 1, 1), claim(8 * M, 1, 0), claim(8 * M, 1, 0)];

  it('is the most important wanted sensor, the first of equals', () => {
    expect(probingSensor(claims, new Set([0, 1, 2]))).toBe(1);
    expect(probingSensor(claims, new Set([0, 2]))).toBe(2);
    expect(probingSensor(claims, new Set([0]))).toBe(0);
  });

  it('is never a failed sensor, and is null if none is wanted', () => {
    expect(probingSensor([claim(0), claim(M, 1, 3)], new Set([0, 1]))).toBe(1);
    expect(probingSensor([claim(0)], new Set([0]))).toBeNull();
    expect(probingSensor(claims, new Set())).toBeNull();
  });
});
