import fc from 'fast-check';
import { beforeAll, describe, expect, test } from 'vitest';
import { CloudDecoder } from './cloud-decoder.ts';
import type { Codec } from './codec.ts';
import { CodecError } from './errors.ts';
import { loadCodecFromDisk } from './load-node.ts';

let codec: Codec;
beforeAll(async () => {
  codec = await loadCodecFromDisk();
});

function unpackPlainly(block: Uint8Array): number[] {
  const view = new DataView(block.buffer, block.byteOffset, block.length);
  const count = block.length / 8;
  const points: number[] = [];
  for (let i = 0; i < count; i++) {
    for (let axis = 0; axis < 3; axis++) points.push(view.getInt16(i * 6 + axis * 2, true));
    points.push(view.getInt16(count * 6 + i * 2, true));
  }
  return points;
}

const anyBlock = fc
  .integer({ min: 1, max: 150 })
  .chain((count) => fc.uint8Array({ minLength: count * 8, maxLength: count * 8 }));

describe('CloudDecoder', () => {
  test('unpacks any blocks, full and partial, one after another', () => {
    using decoder = new CloudDecoder(codec, 6);
    fc.assert(
      fc.property(fc.array(anyBlock, { maxLength: 6 }), (blocks) => {
        for (const block of blocks) decoder.put(block);
        expect(decoder.pending).toBe(blocks.length);
        expect([...decoder.unpack()]).toEqual(blocks.flatMap(unpackPlainly));
        expect(decoder.pending).toBe(0);
      }),
      { numRuns: 200, seed: 1 },
    );
  });

  test('refuses blocks that are not 1 to 150 whole points, and more packets than it has room for', () => {
    using decoder = new CloudDecoder(codec, 1);
    for (const length of [0, 7, 9, 1201, 1208]) {
      expect(() => decoder.put(new Uint8Array(length))).toThrow(
        expect.objectContaining({ code: 'bad-count' }),
      );
    }
    decoder.put(new Uint8Array(8));
    expect(() => decoder.put(new Uint8Array(8))).toThrow(
      expect.objectContaining({ code: 'too-many-packets' }),
    );
    expect(decoder.unpack()).toHaveLength(4);
    expect(() => decoder.unpack(2)).toThrow(CodecError);
    decoder.counts[0] = 151;
    expect(() => decoder.unpack(1)).toThrow(expect.objectContaining({ code: 'bad-count' }));
    decoder.counts[0] = 150;
    expect(decoder.unpack(1)).toHaveLength(600);
  });

  test('refuses impossible capacities and layouts', () => {
    expect(() => new CloudDecoder(codec, 0)).toThrow(expect.objectContaining({ code: 'bad-capacity' }));
    expect(() => new CloudDecoder(codec, 1e6)).toThrow(expect.objectContaining({ code: 'bad-capacity' }));
    expect(() => new CloudDecoder(codec, 1, { stride: 1200, dataOffset: 1 })).toThrow(
      expect.objectContaining({ code: 'bad-layout' }),
    );
  });
});
