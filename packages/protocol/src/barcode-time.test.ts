import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { barcodeTimeOfMs, msOfBarcodeTime } from './barcode-time.ts';

const nanoseconds = ({ hi, lo }: { hi: number; lo: number }) => (BigInt(hi) << 32n) | BigInt(lo);

describe('barcodeTimeOfMs', () => {
  it.each([
    [0, 0n],
    [0.000001, 1n],
    [4294.967296, 2n ** 32n],
    [1_795_413_600_123.25, 1_795_413_600_123_250_000n],
    [18_446_744_073_709, 18_446_744_073_709_000_000n],
  ])('%d ms', (ms, exact) => {
    const time = barcodeTimeOfMs(ms);
    expect(nanoseconds(time)).toBe(exact);
    expect(msOfBarcodeTime(time)).toBe(ms);
  });

  it('is exact for what a number of milliseconds can express, and comes back', () => {
    const sample = fc.tuple(fc.integer({ min: 0, max: 2 ** 41 }), fc.integer({ min: 0, max: 255 }));
    fc.assert(
      fc.property(sample, ([wholeMs, part]) => {
        const ms = wholeMs + part / 256;
        const time = barcodeTimeOfMs(ms);
        expect([time.hi >>> 0, time.lo >>> 0]).toEqual([time.hi, time.lo]);
        const exact = BigInt(wholeMs) * 1_000_000n + (BigInt(part) * 1_000_000n) / 256n;
        expect(Number(nanoseconds(time) - exact)).toBeOneOf([0, 1]);
        expect(Math.abs(msOfBarcodeTime(time) - ms)).toBeLessThan(0.00025);
      }),
      { seed: 1, numRuns: 2000 },
    );
  });

  it.each([-1, -1e-9, Number.NaN, Number.POSITIVE_INFINITY, 18_446_744_073_710])('refuses %d ms', (ms) => {
    expect(() => barcodeTimeOfMs(ms)).toThrow(RangeError);
  });
});
