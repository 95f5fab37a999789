import { readPictureFile } from '@farpoint/protocol';
import fc from 'fast-check';
import { encode as encodePng } from 'fast-png';
import { beforeAll, describe, expect, it } from 'vitest';
import { PictureCodec, PictureCodecError } from './picture-codec.ts';

const [width, height] = [64, 48];
const rgba = Uint8Array.from({ length: width * height * 4 }, (_, i) => {
  const [x, y] = [(i >> 2) % width, Math.floor(i / 4 / width)];
  return [x * 3, y * 4, 128, 255][i & 3] as number;
});

let codec: PictureCodec;
beforeAll(async () => {
  codec = await PictureCodec.load();
});

const meanOff = (a: Uint8Array, b: Uint8Array) =>
  a.reduce((sum, value, i) => sum + Math.abs(value - (b[i] as number)), 0) / a.length;

describe('PictureCodec', () => {
  it('encodes JPEG that shows the picture, smaller at lower quality', () => {
    const jpeg = codec.encodeJpeg({ width, height, rgba }, 85);
    expect(readPictureFile(jpeg)).toEqual({ format: 'jpeg', width, height });
    const read = codec.decode('jpeg', jpeg, width * height);
    expect(meanOff(read.rgba, rgba)).toBeLessThan(3);
    expect(codec.encodeJpeg({ width, height, rgba }, 20).length).toBeLessThan(jpeg.length);
  });

  it('reads PNG exactly', () => {
    const png = encodePng({ width, height, data: rgba, channels: 4, depth: 8 });
    expect(codec.decode('png', png, width * height)).toEqual({ width, height, rgba });
  });

  it('refuses what is too large or not in the format, and continues to work', () => {
    const jpeg = codec.encodeJpeg({ width, height, rgba }, 85);
    expect(() => codec.decode('jpeg', jpeg, width * height - 1)).toThrow(PictureCodecError);
    expect(() => codec.decode('png', jpeg, width * height)).toThrow(PictureCodecError);
    expect(() => codec.encodeJpeg({ width, height: 1, rgba }, 85)).toThrow('64 × 1 pixels in 12288 bytes');
    expect(codec.trapped).toBe(false);
    expect(codec.decode('jpeg', jpeg, width * height).width).toBe(width);
  });

  it('reads or refuses damaged pictures', () => {
    const whole = [
      codec.encodeJpeg({ width, height, rgba }, 60),
      encodePng({ width, height, data: rgba, channels: 4, depth: 8 }),
    ];
    let refused = 0;
    fc.assert(
      fc.property(
        fc.nat(1),
        fc.nat(20_000),
        fc.array(fc.tuple(fc.nat(20_000), fc.nat(255)), { maxLength: 4 }),
        (which, cut, changes) => {
          const bytes = (whole[which] as Uint8Array).slice();
          for (const [at, value] of changes) bytes[at % bytes.length] = value;
          try {
            const pixels = codec.decode(
              which === 0 ? 'jpeg' : 'png',
              bytes.subarray(0, 1 + (cut % bytes.length)),
              4096,
            );
            expect(pixels.rgba.length).toBe(pixels.width * pixels.height * 4);
          } catch (error) {
            expect(error).toBeInstanceOf(PictureCodecError);
            refused++;
          }
        },
      ),
      { seed: 9, numRuns: 300 },
    );
    expect(refused).toBeGreaterThan(50);
    expect(codec.trapped).toBe(false);
  });
});
