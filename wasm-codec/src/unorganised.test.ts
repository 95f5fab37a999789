import { readFileSync } from 'node:fs';
import fc from 'fast-check';
import { beforeAll, describe, expect, test } from 'vitest';
import type { Codec } from './codec.ts';
import { CodecError } from './errors.ts';
import { loadCodecFromDisk } from './load-node.ts';
import { UnorganisedDecoder } from './unorganised-decoder.ts';
import { UnorganisedEncoder } from './unorganised-encoder.ts';

let codec: Codec;
beforeAll(async () => {
  codec = await loadCodecFromDisk();
});

interface Vector {
  description: string;
  packet: string;
  stepMm: number;
  origin: number[];
  points: number[][];
}

/** Rings of a spinning sensor over a plane. */
function rings(encoder: UnorganisedEncoder): number {
  const { frame, frameBits } = encoder;
  const points = encoder.capacityPoints;
  for (let i = 0; i < points; i++) {
    const angle = (i % 900) * 0.00698;
    const range = 3 + Math.floor(i / 900) * 1.5 + Math.sin(i * 1.7) * 0.02;
    frame.set([range * Math.cos(angle), range * Math.sin(angle), -1.7], i * 4);
    frameBits[i * 4 + 3] = (0xff00_0000 | (i * 12_345)) >>> 0;
  }
  return points;
}

describe('unorganised', () => {
  test('restores a cloud to within half a grid step, in few bits', () => {
    using encoder = new UnorganisedEncoder(codec, 9000);
    using decoder = new UnorganisedDecoder(codec, 9000);
    const points = rings(encoder);
    const input = encoder.frame.slice();
    const report = encoder.encode({ points, attribute: 'none', order: 'given' });
    expect(report).toMatchObject({ kept: 9000, thinned: 0, rejected: { notFinite: 0, outOfRange: 0 } });
    expect((report.bytes * 8) / 9000).toBeLessThan(9);
    let seen = 0;
    for (let i = 0; i < report.packets; i++) {
      expect(encoder.packet(i).length).toBeLessThanOrEqual(1200);
      expect(decoder.decode(encoder.packet(i))).toBe(encoder.pointsOf(i));
      seen += encoder.pointsOf(i);
    }
    expect(seen).toBe(9000);
    // The rings were given nearest first, and the packets are sent in that order.
    const metres = decoder.metres();
    let worst = 0;
    for (let i = 0; i < points; i++) {
      for (let axis = 0; axis < 3; axis++) {
        const error = Math.abs((metres[i * 3 + axis] as number) - (input[i * 4 + axis] as number));
        worst = Math.max(worst, error);
      }
    }
    expect(worst).toBeLessThan(0.00501);
    const { origin, step, first, count } = decoder.place(1);
    expect([first, step]).toEqual([encoder.pointsOf(0), Math.fround(0.01)]);
    const at = (first + count - 1) * 4;
    expect(origin[0] + (decoder.points[at] as number) * step).toBeCloseTo(
      metres[(first + count - 1) * 3] as number,
      4,
    );
  });

  test('returns colours as 5-6-5, as 6-6-4, and intensities through a palette', () => {
    using encoder = new UnorganisedEncoder(codec, 2);
    const decodeWith = (options: ConstructorParameters<typeof UnorganisedDecoder>[2]): number => {
      using decoder = new UnorganisedDecoder(codec, 2, options);
      expect(decoder.decode(encoder.packet(0))).toBe(1);
      return (decoder.points[3] as number) & 0xffff;
    };
    encoder.frame.set([1, 2, 3]);
    encoder.frameBits[3] = 0xff_00_80_ff;
    encoder.encode({ points: 1, attribute: 'colour' });
    expect(decodeWith({})).toBe((31 << 11) | (32 << 5));
    expect(decodeWith({ colour: '664' })).toBe((63 << 10) | (32 << 4));
    encoder.frameBits[3] = 200;
    encoder.encode({ points: 1, attribute: 'intensity8' });
    expect(decodeWith({})).toBe(200);
    expect(decodeWith({ palette: Uint16Array.from({ length: 256 }, (_, i) => 0xffff - i) })).toBe(
      0xffff - 200,
    );
  });

  test('counts what it cannot send and fits a budget', () => {
    using encoder = new UnorganisedEncoder(codec, 9000);
    const points = rings(encoder);
    encoder.frame[0] = Number.NaN;
    encoder.frame[4] = 501;
    const report = encoder.encode({ points, budgetBytes: 5000, lambda: 1 });
    expect(report.rejected).toEqual({ notFinite: 1, outOfRange: 1 });
    expect(report.kept + report.thinned).toBe(8998);
    expect(report.bytes).toBeLessThanOrEqual(5000);
    expect(report.bytes).toBeGreaterThanOrEqual(4750);
  });

  test('refuses any other bytes with a reason, and remains usable', () => {
    using encoder = new UnorganisedEncoder(codec, 9000);
    using decoder = new UnorganisedDecoder(codec, 9000);
    encoder.encode({ points: rings(encoder) });
    const whole = encoder.packet(0).slice();
    const reasons = ['too-short', 'too-long', 'bad-check'];
    fc.assert(
      fc.property(fc.uint8Array({ maxLength: 1300 }), (bytes) => {
        expect(reasons).toContain(decoder.decode(bytes));
      }),
      { numRuns: 300, seed: 1 },
    );
    expect(decoder.packetCount).toBe(0);
    expect(decoder.decode(whole)).toBe(encoder.pointsOf(0));
  });

  test('refuses wrong calls', () => {
    const fault = (call: () => unknown): string => {
      try {
        call();
      } catch (error) {
        if (error instanceof CodecError) return error.code;
        throw error;
      }
      return 'none';
    };
    using encoder = new UnorganisedEncoder(codec, 10);
    expect(fault(() => encoder.encode({ points: 11 }))).toBe('too-many-points');
    expect(fault(() => encoder.encode({ points: 1, stepMm: 101 }))).toBe('bad-parameter');
    expect(fault(() => encoder.encode({ points: 1, stepMm: 0.5 }))).toBe('bad-count');
    expect(fault(() => encoder.encode({ points: 1, maxPacketBytes: 1201 }))).toBe('bad-parameter');
    expect(fault(() => encoder.encode({ points: 1, lambda: Number.NaN }))).toBe('bad-parameter');
    expect(fault(() => encoder.packet(0))).toBe('bad-count');
    expect(fault(() => new UnorganisedDecoder(codec, 10, { palette: new Uint16Array(9) }))).toBe(
      'bad-parameter',
    );
    expect(fault(() => new UnorganisedEncoder(codec, 0))).toBe('bad-capacity');
  });

  test('gives the points of the conformance vectors', () => {
    const file = new URL('../crates/unorganised-codec/vectors/packets.json', import.meta.url);
    const vectors = JSON.parse(readFileSync(file, 'utf8')) as Vector[];
    using decoder = new UnorganisedDecoder(codec, 4096);
    for (const { description, packet, origin, stepMm, points } of vectors) {
      decoder.clear();
      expect(decoder.decode(Buffer.from(packet, 'hex')), description).toBe(points.length);
      const words = decoder.points;
      const got = points.map((_, i) => [
        ...words.subarray(i * 4, i * 4 + 3),
        (words[i * 4 + 3] as number) & 0xffff,
      ]);
      expect(got, description).toEqual(points);
      decoder.place(0).origin.forEach((metres, axis) => {
        expect(metres).toBeCloseTo(((origin[axis] as number) * stepMm) / 1000, 4);
      });
    }
  });
});
