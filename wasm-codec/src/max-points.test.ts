import { describe, expect, test } from 'vitest';
import { maxPoints } from './max-points.ts';

const cloud = { points: 230_400, framesPerSecond: 10 };

describe('maxPoints', () => {
  test('fills the link with whole packets', () => {
    // 40 Mbit/s at 10 frames/s are 62,500 points: 416 packets and a remainder.
    expect(maxPoints({ ...cloud, bitsPerSecond: 40e6 })).toBe(62_400);
  });

  test('never sends more than the cloud has, nor a partial packet', () => {
    expect(maxPoints({ ...cloud, bitsPerSecond: 1e9 })).toBe(230_400);
    expect(maxPoints({ points: 299, framesPerSecond: 10, bitsPerSecond: 1e9 })).toBe(150);
  });

  test('keeps the lower limit of a tenth of the cloud per second, as in the formula', () => {
    // 0.10 × 230,400 / 10 = 2304 points: 15 packets.
    expect(maxPoints({ ...cloud, bitsPerSecond: 0 })).toBe(2250);
    expect(maxPoints({ ...cloud, bitsPerSecond: 0, floorFraction: 1 })).toBe(22_950);
    expect(maxPoints({ ...cloud, bitsPerSecond: 0, floorFraction: 0 })).toBe(0);
  });

  test.each([
    { bitsPerSecond: -1 },
    { bitsPerSecond: Infinity },
    { bitsPerSecond: Number.NaN },
    { framesPerSecond: 0 },
    { points: 1.5 },
    { floorFraction: 1.1 },
  ])('refuses %o', (change) => {
    expect(() => maxPoints({ ...cloud, bitsPerSecond: 1e6, ...change })).toThrow(
      expect.objectContaining({ code: 'bad-parameter' }),
    );
  });
});
