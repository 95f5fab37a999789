import fc from 'fast-check';
import { expect, test } from 'vitest';
import { BitRate } from './bit-rate.ts';

test('one megabit a second carries 125,000 bytes a second', () => {
  const rate = BitRate.fromMbps(1);
  expect(rate).toBe(1e6);
  expect(BitRate.toMbps(rate)).toBe(1);
  expect(BitRate.toBytesPerSecond(rate)).toBe(125_000);
  expect(BitRate.fromBytesPerSecond(125_000)).toBe(rate);
  expect(BitRate.bytesIn(rate, 20)).toBe(2500);
  expect(BitRate.msFor(rate, 2500)).toBe(20);
  expect(BitRate.of(2500, 20)).toBe(rate);
});

test('the bytes carried in the time that some bytes take are those bytes', () => {
  fc.assert(
    fc.property(fc.integer({ min: 1, max: 1e9 }), fc.integer({ min: 1, max: 1e7 }), (rate, bytes) => {
      expect(BitRate.bytesIn(rate, BitRate.msFor(rate, bytes))).toBeCloseTo(bytes, 3);
    }),
    { seed: 3 },
  );
});
