import { longProperty } from '@farpoint/network-sim/cases';
import { thrown } from '@farpoint/service/testing/thrown';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { compressedPicture } from './compressed-picture.ts';
import { RosFault } from './fault.ts';
import type { Image } from './messages.ts';
import { pictureRows } from './picture-rows.ts';

const header = { stamp: { sec: 0, nanosec: 0 }, frame_id: 'camera' };
type Pixel = readonly [number, number, number];

interface Shape {
  width: number;
  height: number;
  padding: number;
}
const shape = (even: boolean) =>
  fc.record({
    width: fc.integer({ min: 1, max: 6 }).map((n) => (even ? n * 2 : n)),
    height: fc.integer({ min: 1, max: 4 }).map((n) => (even ? n * 2 : n)),
    padding: fc.nat(5),
  });

/** An independent writer: `put` writes pixel (x, y) relative to the start of its row. */
function imageOf(
  { width, height, padding }: Shape,
  encoding: string,
  bytes: number,
  bigEndian: boolean,
  put: (view: DataView, row: number, x: number, y: number) => void,
): Image {
  const step = width * bytes + padding;
  const data = new Uint8Array(step * height);
  const view = new DataView(data.buffer);
  for (let y = 0; y < height; y++) for (let x = 0; x < width; x++) put(view, y * step, x, y);
  return { header, width, height, step, encoding, is_bigendian: bigEndian ? 1 : 0, data };
}

function pixelsOf(image: Image): Pixel[] {
  const rows = pictureRows(image);
  const line = new Uint8Array(rows.width * 4);
  return Array.from({ length: rows.height }, (_, row) => {
    rows.readRow(row, line);
    return Array.from({ length: rows.width }, (_, x): Pixel => {
      expect(line[x * 4 + 3]).toBe(255);
      return [line[x * 4] as number, line[x * 4 + 1] as number, line[x * 4 + 2] as number];
    });
  }).flat();
}

const value = (x: number, y: number, channel: number) => (x * 37 + y * 11 + channel * 90) & 0xff;

describe('pictureRows', () => {
  it.each([
    ['rgb8', 3, [0, 1, 2]],
    ['bgr8', 3, [2, 1, 0]],
    ['8UC3', 3, [2, 1, 0]],
    ['rgba8', 4, [0, 1, 2]],
    ['bgra8', 4, [2, 1, 0]],
    ['mono8', 1, [0, 0, 0]],
  ] as const)('reads %s with padded rows', (encoding, bytes, order) => {
    fc.assert(
      fc.property(shape(false), (sides) => {
        const image = imageOf(sides, encoding, bytes, false, (view, row, x, y) => {
          for (let c = 0; c < bytes; c++) view.setUint8(row + x * bytes + c, value(x, y, c));
        });
        const expected = Array.from({ length: sides.width * sides.height }, (_, i) =>
          order.map((c) => value(i % sides.width, Math.floor(i / sides.width), c)),
        );
        expect(pixelsOf(image)).toEqual(expected);
      }),
    );
  });

  it('reads 16 bits and floats of either endianness as grey', () => {
    fc.assert(
      fc.property(shape(false), fc.boolean(), (sides, big) => {
        const deep = imageOf(sides, 'mono16', 2, big, (view, row, x, y) =>
          view.setUint16(row + x * 2, value(x, y, 0) * 256 + 99, !big),
        );
        pixelsOf(deep).forEach((pixel, i) => {
          const grey = value(i % sides.width, Math.floor(i / sides.width), 0);
          expect(pixel).toEqual([grey, grey, grey]);
        });
        const metres = [0, 0.5, 4, 100, Number.NaN, Number.POSITIVE_INFINITY, -1];
        const shown = [0, 242, 148, 40, 0, 0, 0];
        const floats = imageOf(sides, '32FC1', 4, big, (view, row, x) =>
          view.setFloat32(row + x * 4, metres[x % 7] as number, !big),
        );
        pixelsOf(floats).forEach(([grey], i) => {
          expect(grey).toBe(shown[(i % sides.width) % 7]);
        });
        const millimetres = imageOf(sides, '16UC1', 2, big, (view, row, x) =>
          view.setUint16(row + x * 2, [0, 500, 4000, 60_000][x % 4] as number, !big),
        );
        pixelsOf(millimetres).forEach(([grey], i) => {
          expect(grey).toBe(shown[(i % sides.width) % 4]);
        });
      }),
    );
  });

  it.each([
    ['yuv422', 1, 0],
    ['uyvy', 1, 0],
    ['yuv422_yuy2', 0, 1],
    ['yuyv', 0, 1],
  ] as const)('reads %s', (encoding, luma, chroma) => {
    // BT.601 in video range: white, black, red, blue, and a grey beside a white in one pair.
    const pairs: [number, number, number, number, Pixel, Pixel][] = [
      [235, 235, 128, 128, [255, 255, 255], [255, 255, 255]],
      [16, 16, 128, 128, [0, 0, 0], [0, 0, 0]],
      [81, 81, 90, 240, [254, 0, 0], [254, 0, 0]],
      [41, 41, 240, 110, [0, 0, 255], [0, 0, 255]],
      [126, 235, 128, 128, [128, 128, 128], [255, 255, 255]],
    ];
    for (const [first, second, u, v, left, right] of pairs) {
      const image = imageOf({ width: 4, height: 2, padding: 3 }, encoding, 2, false, (view, row, x) => {
        view.setUint8(row + x * 2 + luma, x % 2 === 0 ? first : second);
        view.setUint8(row + x * 2 + chroma, x % 2 === 0 ? u : v);
      });
      pixelsOf(image).forEach((pixel, i) => {
        const expected = i % 2 === 0 ? left : right;
        for (const c of [0, 1, 2] as const) expect(Math.abs(pixel[c] - expected[c])).toBeLessThanOrEqual(2);
      });
    }
  });

  it.each(
    ['rggb', 'bggr', 'gbrg', 'grbg'].flatMap((square) =>
      [8, 16].flatMap((bits) => [false, true].map((big) => [square, bits, big] as const)),
    ),
  )('reads bayer_%s%i, big-endian %s', (square, bits, big) => {
    fc.assert(
      fc.property(shape(true), fc.tuple(fc.nat(255), fc.nat(255), fc.nat(255)), (sides, [r, g, b]) => {
        const bytes = bits / 8;
        const image = imageOf(sides, `bayer_${square}${bits}`, bytes, big, (view, row, x, y) => {
          const level = { r, g, b }[square[(y % 2) * 2 + (x % 2)] as 'r' | 'g' | 'b'];
          if (bits === 8) view.setUint8(row + x, level);
          else view.setUint16(row + x * 2, level * 256 + 17, !big);
        });
        for (const pixel of pixelsOf(image)) expect(pixel).toEqual([r, g, b]);
      }),
      { numRuns: 20 },
    );
  });

  it('refuses inconsistent images, and never reads beyond the data', () => {
    const wild = fc.record({
      width: fc.oneof({ weight: 5, arbitrary: fc.nat(20) }, fc.integer({ min: 0, max: 0xffffffff })),
      height: fc.oneof({ weight: 5, arbitrary: fc.nat(4) }, fc.integer({ min: 0, max: 0xffffffff })),
      step: fc.integer({ min: 0, max: 90 }),
      is_bigendian: fc.boolean(),
      encoding: fc.constantFrom(
        ...['rgb8', 'bgra8', 'mono8', 'mono16', '16UC1', '32FC1', 'yuyv', 'uyvy', 'bayer_rggb8'],
        ...['bayer_gbrg16', 'nv21', '', '__proto__', 'constructor'],
      ),
      data: fc.uint8Array({ maxLength: 400, size: 'max' }),
    });
    let read = 0;
    fc.assert(
      fc.property(wild, (fields) => {
        // Bytes behind the data must not appear in the output: 0xee is nowhere in it.
        const around = new Uint8Array(fields.data.length + 64).fill(0xee);
        around.set(fields.data.map((byte) => byte & 0x7f));
        const image = { header, ...fields, data: around.subarray(0, fields.data.length) };
        try {
          for (const pixel of pixelsOf(image)) {
            if (/8$/.test(fields.encoding)) expect(pixel).not.toContain(0xee);
            for (const channel of pixel) expect(Number.isInteger(channel)).toBe(true);
          }
          read++;
        } catch (error) {
          expect(error).toBeInstanceOf(RosFault);
        }
      }),
      longProperty(4, 4000),
    );
    expect(read).toBeGreaterThan(50);
  });

  it('says what is wrong', () => {
    const image = imageOf({ width: 4, height: 4, padding: 0 }, 'rgb8', 3, false, () => {});
    const saying: [Partial<Image>, string][] = [
      [{ encoding: 'nv21' }, 'a picture as nv21; the encodings are rgb8'],
      [{ step: 11 }, 'a row of 11 bytes for 4 pixels of 3'],
      [{ data: image.data.subarray(0, 47) }, 'byte 47: the data ends'],
      [{ width: 0 }, '0 × 4 pixels'],
      [{ width: 9000, height: 9000 }, '9000 × 9000 pixels, room for'],
      [{ encoding: 'yuyv', width: 3 }, 'whose sides are even'],
      [{ encoding: 'bayer_rggb8', height: 3 }, 'whose sides are even'],
    ];
    for (const [change, words] of saying) expect(() => pictureRows({ ...image, ...change })).toThrow(words);
  });
});

describe('compressedPicture', () => {
  const png = (width: number, height: number) => {
    const data = new Uint8Array(33);
    data.set([0x89, 0x50, 0x4e, 0x47, 13, 10, 0x1a, 10, 0, 0, 0, 13, 0x49, 0x48, 0x44, 0x52]);
    new DataView(data.buffer).setUint32(16, width);
    new DataView(data.buffer).setUint32(20, height);
    return { format: 'rgb8; png compressed bgr8', data };
  };

  it('identifies the format by the bytes, not by the name', () => {
    const jpegData = Uint8Array.from([0xff, 0xd8, 0xff, 0xc0, 0, 11, 8, 1, 0xe0, 2, 0x80, 1, 1, 0x11, 0]);
    expect(compressedPicture({ format: 'png', data: jpegData })).toEqual({
      ...{ format: 'jpeg', width: 640, height: 480 },
    });
    expect(compressedPicture(png(320, 200))).toEqual({ format: 'png', width: 320, height: 200 });
  });

  it('refuses by name and by size', () => {
    const refused = (message: Parameters<typeof compressedPicture>[0]) =>
      thrown(RosFault, () => compressedPicture(message)).code;
    expect(refused({ ...png(320, 200), format: '16UC1; compressedDepth' })).toBe('unsupported');
    expect(refused({ format: 'webp', data: new Uint8Array(30) })).toBe('unsupported');
    expect(refused(png(0, 200))).toBe('bad-image');
    expect(refused(png(4097, 200))).toBe('too-large');
    expect(refused({ ...png(3, 3), data: png(3, 3).data.subarray(0, 20) })).toBe('bad-image');
  });
});
