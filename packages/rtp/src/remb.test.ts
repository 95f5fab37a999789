import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { readRemb } from './remb.ts';

const remb = (count: number, word: number, ssrcs: number) =>
  new Uint8Array([
    ...[0x8f, 206, 0, 4 + ssrcs, 0, 0, 0, 1, 0, 0, 0, 0, 0x52, 0x45, 0x4d, 0x42],
    ...[count, (word >> 16) & 0xff, (word >> 8) & 0xff, word & 0xff],
    ...new Array(4 * ssrcs).fill(7),
  ]);

describe('readRemb', () => {
  it('reads mantissa and exponent', () => {
    expect(readRemb(remb(1, 1000, 1))).toBe(1000);
    expect(readRemb(remb(1, (10 << 18) | 5000, 1))).toBe(5_120_000);
    expect(readRemb(remb(0, (63 << 18) | 0x3ffff, 0))).toBe(0x3ffff * 2 ** 63);
  });

  it('refuses other application feedback, and a message with an incomplete list of streams', () => {
    expect(readRemb(remb(1, 1000, 1).fill(0x41, 12, 16))).toBeNull();
    expect(readRemb(remb(3, 1000, 1))).toBeNull();
    fc.assert(
      fc.property(fc.uint8Array({ maxLength: 40 }), (bytes) => {
        expect(readRemb(bytes)).toBeNull();
      }),
      { seed: 10, numRuns: 1000 },
    );
  });
});
