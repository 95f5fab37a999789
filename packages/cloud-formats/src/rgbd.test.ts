import fc from 'fast-check';
import { encode as encodePng } from 'fast-png';
import jpeg from 'jpeg-js';
import { describe, expect, it } from 'vitest';
import {
  decodeColourJpeg,
  decodeDepthPng,
  imagesOfRgbd,
  parseIntrinsics,
  pointsOfRgbd,
  RgbdError,
} from './rgbd.ts';

const camera = { width: 2, height: 2, fx: 2, fy: 4, cx: 0.5, cy: 0.5 };
const png = (data: Uint16Array | Uint8Array, depth: 8 | 16) =>
  encodePng({ width: 2, height: 2, data, depth, channels: 1 });

describe('RGB-D', () => {
  it('reads 16-bit depth to the millimetre', () => {
    const millimetres = Uint16Array.of(0, 1, 1234, 65_535);
    expect(decodeDepthPng(png(millimetres, 16))).toEqual({ width: 2, height: 2, millimetres });
  });

  it('projects pixels to points in the optical frame, NaN where nothing was measured', () => {
    const rgba = Uint8Array.from({ length: 16 }, (_, i) => i);
    const points = pointsOfRgbd(
      { width: 2, height: 2, millimetres: Uint16Array.of(2000, 0, 1000, 4000) },
      { width: 2, height: 2, rgba },
      camera,
    );
    expect([...points.subarray(0, 3)]).toEqual([-0.5, -0.25, 2]);
    expect(points.subarray(4, 7).every(Number.isNaN)).toBe(true);
    expect([...points.subarray(12, 15)]).toEqual([1, 0.5, 4]);
    expect([...new Uint8Array(points.buffer, 3 * 16 + 12, 4)]).toEqual([12, 13, 14, 15]);
  });

  it('converts to images of metres and words', () => {
    const { depth, colour } = imagesOfRgbd(
      { width: 2, height: 2, millimetres: Uint16Array.of(2000, 0, 1000, 65_535) },
      { width: 2, height: 2, rgba: Uint8Array.from({ length: 16 }, (_, i) => i) },
      camera,
    );
    expect(depth).toEqual(Float32Array.of(2, 0, 1, 65.535));
    expect([...colour]).toEqual([0x0302_0100, 0x0706_0504, 0x0b0a_0908, 0x0f0e_0d0c]);
  });

  it('reads JPEG colours', () => {
    const grey = { width: 8, height: 8, data: Buffer.alloc(256, 128) };
    const { width, height, rgba } = decodeColourJpeg(jpeg.encode(grey, 90).data);
    expect([width, height, rgba.length]).toEqual([8, 8, 256]);
    expect(Math.abs((rgba[0] as number) - 128)).toBeLessThan(3);
  });

  it('reads the column-major matrix of Open3D', () => {
    const text = JSON.stringify({ width: 4, height: 3, intrinsic_matrix: [5, 0, 0, 0, 6, 0, 1.5, 1, 1] });
    expect(parseIntrinsics(text)).toEqual({ width: 4, height: 3, fx: 5, fy: 6, cx: 1.5, cy: 1 });
  });

  it.each([
    ['no JSON', () => parseIntrinsics('{')],
    ['a short matrix', () => parseIntrinsics('{"width":1,"height":1,"intrinsic_matrix":[1]}')],
    [
      'no focal length',
      () => parseIntrinsics('{"width":1,"height":1,"intrinsic_matrix":[0,0,0,0,1,0,0,0,1]}'),
    ],
    ['8-bit depth', () => decodeDepthPng(png(Uint8Array.of(1, 2, 3, 4), 8))],
    [
      'another size',
      () =>
        pointsOfRgbd(
          { width: 1, height: 1, millimetres: Uint16Array.of(1) },
          { width: 2, height: 2, rgba: new Uint8Array(16) },
          camera,
        ),
    ],
  ])('refuses %s', (_, read) => {
    expect(read).toThrow(RgbdError);
  });

  it('any input is decoded or throws an RgbdError', () => {
    const depth = png(Uint16Array.of(1, 2, 3, 4), 16);
    const colour = jpeg.encode({ width: 8, height: 8, data: Buffer.alloc(256, 99) }, 80).data;
    const edits = fc.array(fc.tuple(fc.nat(), fc.nat(255)), { maxLength: 5 });
    fc.assert(
      fc.property(fc.boolean(), edits, fc.nat(), (isDepth, changes, cut) => {
        const good = isDepth ? depth : colour;
        const file = Uint8Array.from(good.subarray(0, 1 + (cut % good.length)));
        for (const [at, value] of changes) file[at % file.length] = value;
        try {
          if (isDepth) decodeDepthPng(file);
          else decodeColourJpeg(file);
        } catch (error) {
          expect(error).toBeInstanceOf(RgbdError);
        }
      }),
      { seed: 7, numRuns: 300 },
    );
  });
});
