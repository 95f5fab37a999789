import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { decompressLzf, LzfError } from './lzf.ts';
import { compressLzf } from './lzf-writer.ts';

describe('decompressLzf', () => {
  it('reads literals, short and long copies', () => {
    // "ab", then 3 bytes from 2 back, then 9 + 4 from 1 back.
    const input = Uint8Array.of(1, 97, 98, 1 << 5, 1, 7 << 5, 4, 0);
    const text = new TextDecoder().decode(decompressLzf(input, 18));
    expect(text).toBe(`ababa${'a'.repeat(13)}`);
  });

  it('restores what was compressed', () => {
    const runs = fc
      .array(fc.tuple(fc.integer({ min: 0, max: 255 }), fc.integer({ min: 1, max: 600 })), { maxLength: 40 })
      .map((pairs) => Uint8Array.from(pairs.flatMap(([value, count]) => Array<number>(count).fill(value))));
    fc.assert(
      fc.property(fc.oneof(fc.uint8Array({ maxLength: 3000 }), runs), (data) => {
        expect(decompressLzf(compressLzf(data), data.length)).toEqual(data);
      }),
      { seed: 1 },
    );
  });

  it.each([
    ['truncated', [5, 1, 2], 6],
    ['truncated', [7 << 5], 20],
    ['truncated', [0, 1, 1 << 5], 4],
    ['bad-reference', [0, 1, 1 << 5, 1], 4],
    ['overflow', [1, 1, 2], 1],
    ['overflow', [0, 1, 1 << 5, 0], 3],
    ['underflow', [0, 1], 2],
  ])('refuses with %s', (code, input, bytes) => {
    expect(() => decompressLzf(Uint8Array.from(input), bytes)).toThrow(
      expect.objectContaining({ name: 'LzfError', code }),
    );
  });

  it('any input is decompressed or throws an LzfError', () => {
    fc.assert(
      fc.property(fc.uint8Array({ maxLength: 200 }), fc.nat(2000), (input, bytes) => {
        try {
          expect(decompressLzf(input, bytes).length).toBe(bytes);
        } catch (error) {
          expect(error).toBeInstanceOf(LzfError);
        }
      }),
      { seed: 2, numRuns: 2000 },
    );
  });
});
