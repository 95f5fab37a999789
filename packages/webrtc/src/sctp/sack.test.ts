import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { isSctpPacket } from './packet-check.ts';
import { clipBlocks, type GapBlock, MAX_BLOCKS, MAX_REPEATED, writeSack } from './sack.ts';

/** In order and disjoint, as the check of packets demands. */
const anyBlocks = fc
  .uniqueArray(fc.integer({ min: 1, max: 3000 }), { maxLength: 40 })
  .map((numbers) => numbers.toSorted((a, b) => a - b))
  .map((numbers) =>
    Array.from({ length: numbers.length >> 1 }, (_, n): GapBlock => [numbers[2 * n]!, numbers[2 * n + 1]!]),
  );

const numbersOf = (blocks: readonly Readonly<GapBlock>[]) =>
  blocks.flatMap(([start, end]) => Array.from({ length: end - start + 1 }, (_, n) => start + n));

describe('writeSack', () => {
  it('writes what RFC 9260 says', () => {
    const sack = { last: 0x01020304, room: 500, blocks: [[2, 3]] as GapBlock[], repeated: [9] };
    expect([...writeSack(sack)]).toEqual([
      3, 0, 0, 24, 1, 2, 3, 4, 0, 0, 1, 244, 0, 1, 0, 1, 0, 2, 0, 3, 0, 0, 0, 9,
    ]);
  });

  it('fits into a packet at its longest, and never announces less than no room', () => {
    const blocks = Array.from({ length: MAX_BLOCKS }, (_, n): GapBlock => [2 * n + 2, 2 * n + 2]);
    const repeated = new Array<number>(MAX_REPEATED).fill(2 ** 32 - 1);
    const bytes = writeSack({ last: 2 ** 32 - 1, room: -5, blocks, repeated });
    expect(12 + bytes.length).toBeLessThanOrEqual(1191);
    expect(bytes.readUInt32BE(8)).toBe(0);
    expect(isSctpPacket(Buffer.concat([Buffer.alloc(12), bytes]))).toBe(true);
  });
});

describe('clipBlocks', () => {
  it('keeps exactly what was sent', () => {
    fc.assert(
      fc.property(anyBlocks, fc.integer({ min: 0, max: 4000 }), (blocks, most) => {
        const before = numbersOf(blocks);
        clipBlocks(blocks, most);
        expect(numbersOf(blocks)).toEqual(before.filter((number) => number <= most));
      }),
      { seed: 8, numRuns: 200 },
    );
  });
});
