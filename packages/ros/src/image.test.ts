import { longProperty } from '@farpoint/network-sim/cases';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { RosFault } from './fault.ts';
import { colourOf, depthOf, pinholeOf } from './image.ts';
import type { Image } from './messages.ts';

const header = { stamp: { sec: 0, nanosec: 0 }, frame_id: 'camera_optical_frame' };
const size = {
  width: fc.integer({ min: 1, max: 9 }),
  height: fc.integer({ min: 1, max: 5 }),
  padding: fc.integer({ min: 0, max: 5 }),
};

/** An independent writer: pixel by pixel. */
function imageOf(
  { width, height, padding }: { width: number; height: number; padding: number },
  encoding: string,
  bytes: number,
  bigEndian: boolean,
  put: (view: DataView, at: number, pixel: number) => void,
): Image {
  const step = width * bytes + padding;
  const data = new Uint8Array(step * height);
  const view = new DataView(data.buffer);
  for (let i = 0; i < width * height; i++) put(view, Math.floor(i / width) * step + (i % width) * bytes, i);
  return { header, width, height, step, encoding, is_bigendian: bigEndian ? 1 : 0, data };
}

describe('images', () => {
  it('reads depth in millimetres and metres, of either endianness, with padded rows', () => {
    fc.assert(
      fc.property(fc.record(size), fc.boolean(), fc.boolean(), (sides, bigEndian, metres) => {
        const image = metres
          ? imageOf(sides, '32FC1', 4, bigEndian, (view, at, i) => view.setFloat32(at, i * 0.25, !bigEndian))
          : imageOf(sides, '16UC1', 2, bigEndian, (view, at, i) => view.setUint16(at, i * 250, !bigEndian));
        const into = new Float32Array(sides.width * sides.height);
        depthOf(image, into);
        expect([...into]).toEqual(Array.from(into, (_, i) => i * 0.25));
      }),
    );
  });

  it.each([
    ['rgb8', 3, [0, 1, 2]],
    ['bgr8', 3, [2, 1, 0]],
    ['rgba8', 4, [0, 1, 2]],
    ['bgra8', 4, [2, 1, 0]],
    ['mono8', 1, [0, 0, 0]],
  ] as const)('reads %s with padded rows', (encoding, bytes, [red, green, blue]) => {
    fc.assert(
      fc.property(fc.record(size), (sides) => {
        const channel = (i: number, c: number) => (i * 7 + c * 50) & 0xff;
        const image = imageOf(sides, encoding, bytes, false, (view, at, i) => {
          for (let c = 0; c < bytes; c++) view.setUint8(at + c, channel(i, c));
        });
        const into = new Uint32Array(sides.width * sides.height);
        colourOf(image, into);
        const read = new Uint8Array(into.buffer);
        for (let i = 0; i < into.length; i++) {
          const expected = [channel(i, red), channel(i, green), channel(i, blue), 255];
          expect([...read.subarray(i * 4, i * 4 + 4)]).toEqual(expected);
        }
      }),
    );
  });

  it('refuses inconsistent images, and never reads beyond the data', () => {
    const wild = fc.record({
      width: fc.oneof(fc.integer({ min: 0, max: 20 }), fc.integer({ min: 0, max: 0xffffffff })),
      height: fc.oneof(fc.integer({ min: 0, max: 4 }), fc.integer({ min: 0, max: 0xffffffff })),
      step: fc.integer({ min: 0, max: 90 }),
      is_bigendian: fc.boolean(),
      encoding: fc.constantFrom('16UC1', '32FC1', 'rgb8', 'bgra8', 'mono8', 'bayer_rggb8', '', '__proto__'),
      data: fc.uint8Array({ maxLength: 300 }),
    });
    let read = 0;
    fc.assert(
      fc.property(wild, fc.boolean(), (fields, asDepth) => {
        const image: Image = { header, ...fields };
        // Bytes behind the data must not appear in the output.
        const around = new Uint8Array(image.data.length + 64).fill(0xee);
        around.set(image.data, 0);
        image.data = around.subarray(0, image.data.length);
        try {
          if (asDepth) depthOf(image, new Float32Array(100));
          else colourOf(image, new Uint32Array(100));
          read++;
        } catch (error) {
          expect(error).toBeInstanceOf(RosFault);
        }
      }),
      longProperty(2, 2000),
    );
    expect(read).toBeGreaterThan(0);
  });

  it('names the byte where the data ends', () => {
    const image = imageOf({ width: 4, height: 3, padding: 0 }, '16UC1', 2, false, () => {});
    const cut = { ...image, data: image.data.subarray(0, 20) };
    expect(() => depthOf(cut, new Float32Array(12))).toThrow('byte 20: the data ends, 24 bytes expected');
    expect(() => depthOf(image, new Float32Array(11))).toThrow('4 × 3 pixels, room for 11');
  });

  it('takes the camera of rectified images, else that of raw ones', () => {
    const k = [500, 0, 320, 0, 501, 240, 0, 0, 1];
    const p = [490, 0, 321, 0, 0, 491, 241, 0, 0, 0, 1, 0];
    const info = { header, width: 640, height: 480 };
    expect(pinholeOf({ ...info, k, p })).toEqual({ fx: 490, fy: 491, cx: 321, cy: 241 });
    expect(pinholeOf({ ...info, k, p: p.map(() => 0) })).toEqual({ fx: 500, fy: 501, cx: 320, cy: 240 });
    expect(() => pinholeOf({ ...info, k: k.map(() => 0), p: undefined })).toThrow('calibrate the camera');
  });
});
