import fc from 'fast-check';
import { beforeAll, describe, expect, test } from 'vitest';
import type { Codec } from './codec.ts';
import { CodecError } from './errors.ts';
import { loadCodecFromDisk } from './load-node.ts';
import { Points64Encoder, type SamplingParameters } from './points64-encoder.ts';

let codec: Codec;
beforeAll(async () => {
  codec = await loadCodecFromDisk();
});

/** x, y, z, colour for each point. */
type PlainPoint = [number, number, number, number];

function fill(encoder: Points64Encoder, points: readonly PlainPoint[]): void {
  points.forEach(([x, y, z, colour], i) => {
    encoder.frame.set([x, y, z], i * 4);
    encoder.frameBits[i * 4 + 3] = colour;
  });
}

/** The format's rules in plain numbers, implemented again: what the packets must contain. */
function expectedBlock(points: readonly PlainPoint[], latencyTest: boolean): Uint8Array {
  const bytes = new Uint8Array(points.length * 8);
  const view = new DataView(bytes.buffer);
  points.forEach(([x, y, z, colour], i) => {
    for (const [axis, metres] of [x, y, z].entries()) {
      const mm = Math.fround(metres) * 1000;
      const rounded = Math.sign(mm) * Math.floor(Math.abs(mm) + 0.5);
      view.setInt16(i * 6 + axis * 2, Math.max(-32767, Math.min(32767, rounded)), true);
    }
    const [r, g, b] = [colour & 0xff, (colour >> 8) & 0xff, (colour >> 16) & 0xff];
    const bits = latencyTest ? 0x03f0 : ((r >> 2) << 10) | ((g >> 2) << 4) | (b >> 4);
    view.setUint16(points.length * 6 + i * 2, bits, true);
  });
  return bytes;
}

function blockOf(encoder: Points64Encoder, packet: number, points: number): Uint8Array {
  const begin = packet * encoder.layout.stride + encoder.layout.dataOffset;
  return encoder.packets.slice(begin, begin + points * 8);
}

const anyCoordinate = fc.oneof(
  fc.float({ min: -40, max: 40 }),
  fc.constantFrom(Number.NaN, Infinity, -Infinity, 0, -0, 32.767, -32.767, 32.7675, 33, 3e38, 1e-40),
  // Halves of a millimetre: where rounding shows.
  fc.integer({ min: -65_534, max: 65_534 }).map((half) => half / 2000),
);
const anyPoint = fc.tuple(anyCoordinate, anyCoordinate, anyCoordinate, fc.nat({ max: 0xffffffff }));

function reasonFor([x, y, z]: PlainPoint, parameters: SamplingParameters): string {
  const c = [x, y, z].map(Math.fround) as [number, number, number];
  if (!c.every(Number.isFinite)) return 'notFinite';
  // Below a micrometre, a depth counts as none.
  const depth = parameters.depthMeasure === 'range' ? Math.hypot(...c) : c[2];
  if (depth < 1e-6) return 'nonPositiveDepth';
  const far = c.some((value) => Math.abs(value) > Math.fround(32.767));
  return far && parameters.outOfRange !== 'saturate' ? 'outOfRange' : 'valid';
}

describe('Points64Encoder', () => {
  test('counts, keeps and packs any points by the rules of the format', () => {
    const capacity = 400;
    using encoder = new Points64Encoder(codec, capacity);
    const options = fc.record({
      points: fc.array(anyPoint, { maxLength: capacity }),
      count: fc.integer({ min: 0, max: 500 }),
      seed: fc.bigInt({ min: 0n, max: 2n ** 64n - 1n }),
      lambda: fc.constantFrom(0, 0.5, 1, 3, 7.25, 9, 64),
      depthMeasure: fc.constantFrom('z' as const, 'range' as const),
      outOfRange: fc.constantFrom('reject' as const, 'saturate' as const),
      latencyTest: fc.boolean(),
    });
    fc.assert(
      fc.property(options, ({ points, latencyTest, ...rest }) => {
        fill(encoder, points);
        const parameters = { ...rest, points: points.length };
        const report = encoder.sample(parameters);
        const reasons = points.map((point) => reasonFor(point, parameters));
        const counted = (reason: string) => reasons.filter((it) => it === reason).length;
        const valid = counted('valid');
        expect(report.kept).toBe(Math.min(valid, rest.count));
        expect(report.rejected).toEqual({
          notFinite: counted('notFinite'),
          nonPositiveDepth: counted('nonPositiveDepth'),
          outOfRange: counted('outOfRange'),
          notDrawn: valid - report.kept,
        });

        const chosen = [...encoder.chosen];
        expect(chosen).toHaveLength(report.kept);
        expect(chosen.every((index, i) => i === 0 || (chosen[i - 1] as number) < index)).toBe(true);
        expect(chosen.every((index) => reasons[index] === 'valid')).toBe(true);

        const packed = encoder.pack({ latencyTest });
        const sent = chosen.map((index) => points[index] as PlainPoint);
        const saturates = (metres: number) => Math.abs(Math.fround(metres)) * 1000 >= 32767.5;
        expect(packed).toEqual({
          packets: Math.ceil(sent.length / 150),
          points: sent.length,
          saturated: sent.filter(([x, y, z]) => saturates(x) || saturates(y) || saturates(z)).length,
        });
        for (let packet = 0; packet < packed.packets; packet++) {
          const block = sent.slice(packet * 150, (packet + 1) * 150);
          expect(blockOf(encoder, packet, block.length)).toEqual(expectedBlock(block, latencyTest));
        }
      }),
      { numRuns: 300, seed: 1 },
    );
  });

  test('packs near bands of depth first, in raster order within a band', () => {
    using encoder = new Points64Encoder(codec, 8);
    const depths = [9, 0.5, 3, 1.5, 20, 0.75, 1.25, 4];
    fill(
      encoder,
      depths.map((z, i): PlainPoint => [0, 0, z, i << 2]),
    );
    encoder.sample({ points: 8, count: 8, seed: 0, lambda: 0 });
    encoder.pack({ order: 'near-first' });
    const ordered = [0.5, 0.75, 1.5, 1.25, 3, 4, 9, 20].map(
      (z): PlainPoint => [0, 0, z, depths.indexOf(z) << 2],
    );
    expect(blockOf(encoder, 0, 8)).toEqual(expectedBlock(ordered, false));
    expect([...encoder.chosen]).toEqual([0, 1, 2, 3, 4, 5, 6, 7]);
  });

  test('gives the same choice for the same seed and a different one for another', () => {
    using encoder = new Points64Encoder(codec, 10_000);
    const points = Array.from({ length: 10_000 }, (_, i): PlainPoint => [0, 0, 1 + i / 1000, i]);
    fill(encoder, points);
    const draw = (seed: number | bigint) => {
      encoder.sample({ points: 10_000, count: 500, seed });
      return [...encoder.chosen];
    };
    const first = draw(1);
    expect(draw(2)).not.toEqual(first);
    expect(draw(1n)).toEqual(first);
    // All 64 bits of the seed count.
    expect(draw(1n + 2n ** 63n)).not.toEqual(first);
  });

  test('leaves headers and trailers unchanged', () => {
    const layout = { stride: 1300, dataOffset: 40 };
    using encoder = new Points64Encoder(codec, 300, layout);
    fill(
      encoder,
      Array.from({ length: 300 }, (): PlainPoint => [1, 2, 3, 0xffffffff]),
    );
    encoder.packets.fill(0xaa);
    encoder.sample({ points: 300, count: 200, seed: 0 });
    expect(encoder.pack().packets).toBe(2);
    const { packets } = encoder;
    const untouched = [...packets.keys()].filter((at) => packets[at] === 0xaa).length;
    expect(untouched).toBe(2600 - 200 * 8);
    expect(packets.subarray(0, 40).every((byte) => byte === 0xaa)).toBe(true);
    expect(packets.subarray(1300 + 40 + 50 * 8).every((byte) => byte === 0xaa)).toBe(true);
  });

  test('gives the same packets for images as for their points', () => {
    const [width, height, fx, fy, cx, cy] = [20, 30, 12, 13, 9.5, 14.5];
    const byPoints = new Points64Encoder(codec, width * height);
    const byImages = new Points64Encoder(codec, width * height);
    byImages.setCamera({ width, height, fx, fy, cx, cy });
    for (let i = 0; i < width * height; i++) {
      const depth = i % 11 === 0 ? 0 : Math.fround(0.5 + ((i * 7919) % 1000) / 100);
      const x = Math.fround(((i % width) - cx) / fx) * depth;
      const y = Math.fround((Math.floor(i / width) - cy) / fy) * depth;
      byPoints.frame.set([x, y, depth], i * 4);
      byPoints.frameBits[i * 4 + 3] = (i * 2_654_435_761) >>> 0;
      byImages.depth[i] = depth;
      byImages.colour[i] = (i * 2_654_435_761) >>> 0;
    }
    for (const count of [0, 17, 300, 600]) {
      const sampled = byPoints.sample({ points: width * height, count, seed: 5 });
      expect(byImages.sampleImages({ count, seed: 5 })).toEqual(sampled);
      const packed = byPoints.pack({ order: 'near-first' });
      expect(byImages.pack({ order: 'near-first' })).toEqual(packed);
      expect(byImages.packets).toEqual(byPoints.packets);
    }
  });

  test('requires a camera that it has room for before images', () => {
    const encoder = new Points64Encoder(codec, 100);
    const camera = { width: 10, height: 10, fx: 5, fy: 5, cx: 4.5, cy: 4.5 };
    expect(() => encoder.sampleImages({ count: 1, seed: 0 })).toThrow(
      expect.objectContaining({ code: 'no-stream' }),
    );
    for (const wrong of [{ height: 11 }, { width: 0 }, { width: 2.5 }, { fx: 0 }, { cy: Number.NaN }]) {
      expect(() => encoder.setCamera({ ...camera, ...wrong })).toThrow(
        expect.objectContaining({ code: 'bad-parameter' }),
      );
    }
    encoder.setCamera(camera);
    expect(encoder.sampleImages({ count: 1, seed: 0 })).toMatchObject({ kept: 0 });
  });

  test('keeps working when the memory grows, and each encoder has its own frame', () => {
    using first = new Points64Encoder(codec, 1000);
    const before = first.frame;
    fill(first, [[1, 2, 3, 0x123456]]);
    // Other tests may have left room in the memory.
    using room = new DisposableStack();
    for (let i = 0; i < 20 && before.length > 0; i++) room.use(new Points64Encoder(codec, 2_000_000));
    using second = new Points64Encoder(codec, 2_000_000);
    expect(before.length).toBe(0);
    fill(second, [[4, 5, 6, 0]]);
    expect(first.sample({ points: 1, count: 1, seed: 0 }).maxDepth).toBe(3);
    first.pack();
    expect(blockOf(first, 0, 1)).toEqual(expectedBlock([[1, 2, 3, 0x123456]], false));
    expect(second.sample({ points: 1, count: 1, seed: 0 }).maxDepth).toBe(6);
  });

  test('refuses what it cannot do, says why, and remains usable', () => {
    const codeOf = (action: () => unknown) => {
      try {
        action();
      } catch (error) {
        if (error instanceof CodecError) return error.code;
        throw error;
      }
      return 'accepted';
    };
    for (const capacity of [0, -1, 1.5, Number.NaN, 2 ** 31]) {
      expect(codeOf(() => new Points64Encoder(codec, capacity))).toBe('bad-capacity');
    }
    for (const layout of [
      { stride: 1215, dataOffset: 16 },
      { stride: 1248, dataOffset: -1 },
      { stride: 1e9, dataOffset: 0 },
      { stride: Number.NaN, dataOffset: 0 },
    ]) {
      expect(codeOf(() => new Points64Encoder(codec, 10, layout))).toBe('bad-layout');
    }
    using encoder = new Points64Encoder(codec, 10);
    const good = { points: 1, count: 1, seed: 0 };
    fill(encoder, [[0, 0, 1, 0]]);
    const wrong: [Partial<SamplingParameters>, string][] = [
      [{ points: 11 }, 'too-many-points'],
      [{ points: -1 }, 'bad-count'],
      [{ count: 0.5 }, 'bad-count'],
      [{ lambda: -1 }, 'bad-parameter'],
      [{ lambda: Number.NaN }, 'bad-parameter'],
      [{ epsilon: 0 }, 'bad-parameter'],
      [{ nearDistance: Infinity }, 'bad-parameter'],
      [{ seed: -1 }, 'bad-parameter'],
      [{ seed: 0.5 }, 'bad-parameter'],
      [{ seed: 2n ** 64n }, 'bad-parameter'],
    ];
    for (const [change, code] of wrong) {
      expect(codeOf(() => encoder.sample({ ...good, ...change }))).toBe(code);
      expect(encoder.chosen).toHaveLength(0);
      expect(encoder.pack().points).toBe(0);
    }
    expect(encoder.sample(good).kept).toBe(1);
  });
});
