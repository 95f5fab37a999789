import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import {
  isLatencyTestBlock,
  isSaturated,
  quantiseMillimetres,
  readPoints64Block,
  writePoints64Block,
} from './points64.ts';
import { readVectors } from './testing/vectors.ts';

interface Block {
  name: string;
  metres: [number, number, number][];
  colours: number[];
  saturated: number;
  hex: string;
}
const vectors = readVectors<{
  quantise: { metres: number; millimetres: number; saturated: boolean }[];
  blocks: Block[];
}>('points64');

/** Writes the block at `offset`, from points that do not begin at the arrays' start. */
function written({ metres, colours }: Pick<Block, 'metres' | 'colours'>, offset = 0): [Uint8Array, number] {
  const bytes = new Uint8Array(offset + metres.length * 8);
  const saturated = writePoints64Block(
    new DataView(bytes.buffer),
    offset,
    new Float32Array([9, 9, 9, ...metres.flat()]),
    new Uint16Array([9, ...colours]),
    1,
    metres.length,
  );
  return [bytes.subarray(offset), saturated];
}

describe('conformance vectors', () => {
  test.each(vectors.quantise)('$metres m', ({ metres, millimetres, saturated }) => {
    // + 0: minus zero is zero on the wire.
    expect(quantiseMillimetres(metres) + 0).toBe(millimetres);
    expect(isSaturated(metres)).toBe(saturated);
  });

  test.each(vectors.blocks)('$name', (block) => {
    const [bytes, saturated] = written(block, 16);
    expect(Buffer.from(bytes).toString('hex')).toBe(block.hex);
    expect(saturated).toBe(block.saturated);
  });

  test.each(vectors.blocks)('read: $name', ({ metres, colours, hex }) => {
    const bytes = new Uint8Array(Buffer.from(`ffff${hex}`, 'hex'));
    const into = new Int16Array(4 * metres.length + 8);
    expect(readPoints64Block(new DataView(bytes.buffer), 2, bytes.length - 2, into, 4)).toBe(metres.length);
    const expected = metres.flatMap((point, i) => [
      ...point.map((c) => quantiseMillimetres(c) + 0),
      ((colours[i] as number) << 16) >> 16,
    ]);
    expect([...into]).toEqual([0, 0, 0, 0, ...expected, 0, 0, 0, 0]);
  });
});

test('rounding and saturation hold for every float', () => {
  fc.assert(
    fc.property(fc.float({ noNaN: true }), (metres) => {
      const millimetres = quantiseMillimetres(metres);
      expect(Number.isInteger(millimetres)).toBe(true);
      expect(Math.abs(millimetres)).toBeLessThanOrEqual(32_767);
      expect(quantiseMillimetres(-metres) + 0).toBe(-millimetres + 0);
      if (isSaturated(metres)) expect(Math.abs(millimetres)).toBe(32_767);
      else expect(Math.abs(millimetres - metres * 1000)).toBeLessThanOrEqual(0.5);
    }),
    { seed: 1, numRuns: 2000 },
  );
});

test('any millimetres and colours survive a round trip', () => {
  const point = fc.tuple(
    fc.integer({ min: -32_767, max: 32_767 }),
    fc.integer({ min: -32_767, max: 32_767 }),
    fc.integer({ min: -32_767, max: 32_767 }),
    fc.nat(0xffff),
  );
  fc.assert(
    fc.property(fc.array(point, { minLength: 1, maxLength: 150, size: 'max' }), (points) => {
      const [bytes] = written({
        metres: points.map(([x, y, z]) => [x / 1000, y / 1000, z / 1000]),
        colours: points.map((p) => p[3]),
      });
      const into = new Int16Array(points.length * 4);
      readPoints64Block(new DataView(bytes.buffer), 0, bytes.length, into, 0);
      expect([...into]).toEqual(points.flatMap(([x, y, z, colour]) => [x, y, z, (colour << 16) >> 16]));
    }),
    { seed: 2, numRuns: 100 },
  );
});

test('a latency-test block is green throughout', () => {
  const block = vectors.blocks.find(({ name }) => name === 'latency test') as Block;
  const [bytes] = written(block);
  const view = new DataView(bytes.buffer);
  expect(isLatencyTestBlock(view, 0, 16)).toBe(true);
  expect(isLatencyTestBlock(view, 0, 0)).toBe(false);
  for (const at of [12, 15]) {
    const other = new DataView(bytes.slice().buffer);
    other.setUint8(at, other.getUint8(at) ^ 1);
    expect(isLatencyTestBlock(other, 0, 16)).toBe(false);
  }
});
