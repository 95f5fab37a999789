import { chmodSync, readFileSync, rmSync, truncateSync, writeFileSync } from 'node:fs';
import { readPoints64Block } from '@farpoint/protocol';
import fc from 'fast-check';
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import {
  ADDON_SUITE,
  codeOf,
  errorOf,
  fromHex,
  readVectors,
  scratchFolder,
  toHex,
} from '../testing/helpers.ts';
import { ReferenceFrameConsumer } from './frame-consumer.ts';
import { ReferenceFrameProducer } from './frame-producer.ts';
import { CLOUD_BYTES, MAX_PAYLOAD_BYTES, MAX_POINTS, type ReferenceFiles, referenceFiles } from './layout.ts';

interface Vectors {
  flags: { ready: number; latencyTest: number; bitsPerSecond: number; hex: string }[];
  clouds: { name: string; hex: string; points?: number[][]; green?: boolean; error?: string }[];
}
const vectors = readVectors<Vectors>('reference.json');
const NO_WISHES = { bitsPerSecond: 0, latencyTest: false };

let folder: string;
let files: ReferenceFiles;
let producer: ReferenceFrameProducer;
let consumer: ReferenceFrameConsumer;
const words = new Uint32Array(MAX_POINTS * 4);
beforeEach(() => {
  folder = scratchFolder();
  files = referenceFiles(folder);
  if (ADDON_SUITE.skip) return;
  producer = new ReferenceFrameProducer(folder);
  consumer = ReferenceFrameConsumer.open(folder);
});
afterEach(() => {
  producer?.close();
  consumer?.close();
});

/** Writes into the file as another program would. */
function patch(path: string, bytes: Uint8Array): void {
  const whole = readFileSync(path);
  whole.set(bytes);
  writeFileSync(path, whole);
}

function pointAt(index: number): number[] {
  const floats = new Float32Array(words.buffer);
  const [x, y, z] = [0, 1, 2].map((axis) => floats[index * 4 + axis] as number);
  const colour = words[index * 4 + 3] as number;
  return [x, y, z, colour & 0xff, (colour >> 8) & 0xff, (colour >> 16) & 0xff] as number[];
}

describe.skipIf(ADDON_SUITE.skip)(`reference frames (${ADDON_SUITE.note})`, () => {
  it('creates the files correctly', () => {
    expect(readFileSync(files.cloud)).toHaveLength(1_843_203);
    expect(readFileSync(files.flags)).toHaveLength(6);
  });

  it.each(vectors.flags)('reads and writes the flags $hex', ({ ready, latencyTest, bitsPerSecond, hex }) => {
    patch(files.flags, fromHex(hex));
    expect(consumer.ready).toBe(ready === 1);
    expect(producer.free).toBe(ready === 0);
    expect(producer.wishes).toEqual({ bitsPerSecond, latencyTest: latencyTest === 1 });
    consumer.release({ bitsPerSecond, latencyTest: latencyTest === 1 });
    expect(toHex(readFileSync(files.flags))).toBe(`00${hex.slice(2)}`);
  });

  it.each(vectors.clouds)('reads the cloud: $name', ({ hex, points, green, error }) => {
    patch(files.cloud, fromHex(hex));
    patch(files.flags, Uint8Array.of(1));
    const take = () => consumer.take(words, { bitsPerSecond: 7, latencyTest: true });
    if (points === undefined) {
      expect(errorOf(take)).toMatchObject({ code: error, file: files.cloud, offset: 0 });
    } else {
      expect(take()).toEqual({ points: points.length, green });
      points.forEach((point, i) => {
        expect(pointAt(i)).toEqual(point);
        expect((words[i * 4 + 3] as number) >>> 24).toBe(255);
      });
    }
    // Whether valid or not, the producer can continue and knows what is requested.
    expect(producer.free).toBe(true);
    expect(producer.wishes).toEqual({ bitsPerSecond: 7, latencyTest: true });
  });

  it('transfers any points, as in the packet format', () => {
    const anyPacked = fc
      .uint8Array({ maxLength: 8 * 460 })
      .map((bytes) => bytes.subarray(0, bytes.length & ~7));
    fc.assert(
      fc.property(anyPacked, (packed) => {
        expect(consumer.take(words, NO_WISHES)).toBeNull();
        expect(producer.publish(packed)).toBe(true);
        expect(toHex(readFileSync(files.cloud).subarray(3, 3 + packed.length))).toBe(toHex(packed));
        expect(producer.publish(packed)).toBe(false);
        const frame = consumer.take(words, NO_WISHES);
        expect(frame?.points).toBe(packed.length / 8);
        const view = new DataView(packed.buffer, packed.byteOffset, packed.byteLength);
        const expected = new Int16Array(packed.length / 2);
        for (let at = 0; at < packed.length; at += 1200) {
          readPoints64Block(view, at, Math.min(1200, packed.length - at), expected, at / 2);
        }
        const floats = new Float32Array(words.buffer, 0, packed.length / 2);
        for (let i = 0; i < packed.length / 8; i++) {
          for (let axis = 0; axis < 3; axis++) {
            expect(floats[i * 4 + axis]).toBe(Math.fround((expected[i * 4 + axis] as number) / 1000));
          }
        }
      }),
      { numRuns: 150, seed: 1 },
    );
  });

  it('survives anything that another program has written', () => {
    fc.assert(
      fc.property(fc.uint8Array({ minLength: 3, maxLength: 40 }), fc.nat({ max: 255 }), (bytes, flag) => {
        patch(files.cloud, bytes);
        patch(files.flags, Uint8Array.of(flag));
        const [low = 0, middle = 0, high = 0] = bytes;
        const length = low + middle * 256 + high * 65_536;
        const take = () => consumer.take(words, NO_WISHES);
        if (flag === 0) expect(take()).toBeNull();
        else if (length > MAX_PAYLOAD_BYTES || length % 8 !== 0) expect(codeOf(take)).toBe('bad-length');
        else expect(take()?.points).toBe(length / 8);
        expect(producer.free).toBe(true);
      }),
      { numRuns: 200, seed: 2 },
    );
  });

  it('carries the maximum number of points', () => {
    const packed = new Uint8Array(MAX_PAYLOAD_BYTES).fill(1);
    expect(producer.publish(packed)).toBe(true);
    expect(consumer.take(words, NO_WISHES)?.points).toBe(230_400);
    expect(pointAt(230_399)[0]).toBe(Math.fround(0.257));
    expect(codeOf(() => producer.publish(new Uint8Array(MAX_PAYLOAD_BYTES + 8)))).toBe('bad-length');
    expect(codeOf(() => producer.publish(new Uint8Array(7)))).toBe('bad-length');
  });

  it('survives truncated files, and continues once they are restored', () => {
    producer.publish(new Uint8Array(1200));
    truncateSync(files.cloud, 0);
    expect(codeOf(() => consumer.take(words, NO_WISHES))).toBe('truncated');
    expect(consumer.current).toBe(false);
    truncateSync(files.cloud, CLOUD_BYTES);
    expect(consumer.current).toBe(true);
    producer.publish(new Uint8Array(1200));
    expect(consumer.take(words, NO_WISHES)?.points).toBe(150);
    truncateSync(files.flags, 0);
    expect(codeOf(() => consumer.ready)).toBe('truncated');
  });

  it('names a file that is missing, of another size or open to everybody', () => {
    const faults: [() => void, string, string][] = [
      [() => truncateSync(files.flags, 7), 'wrong-size', files.flags],
      [() => rmSync(files.flags), 'absent', files.flags],
      [() => chmodSync(files.cloud, 0o646), 'unsafe-permissions', files.cloud],
    ];
    for (const [spoil, code, file] of faults) {
      spoil();
      expect(errorOf(() => ReferenceFrameConsumer.open(folder))).toMatchObject({ code, file });
    }
  });

  it('continues after a producer was killed: before it set the flag, or after', () => {
    patch(files.cloud, fromHex('ffffff'));
    expect(consumer.take(words, NO_WISHES)).toBeNull();
    {
      using next = new ReferenceFrameProducer(folder);
      expect(next.free).toBe(true);
      next.publish(new Uint8Array(16));
    }
    {
      using next = new ReferenceFrameProducer(folder);
      expect(next.free).toBe(false);
    }
    expect(consumer.take(words, NO_WISHES)?.points).toBe(2);
  });
});
