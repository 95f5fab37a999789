import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { readPictureFile } from './picture-file.ts';

const u16 = (value: number) => [value >> 8, value & 0xff];
const u32 = (value: number) => [...u16(value >>> 16), ...u16(value & 0xffff)];
const png = (width: number, height: number) =>
  Uint8Array.from([
    ...[0x89, 0x50, 0x4e, 0x47, 13, 10, 0x1a, 10, 0, 0, 0, 13, 0x49, 0x48, 0x44, 0x52],
    ...[...u32(width), ...u32(height), 8, 2, 0, 0, 0],
  ]);
const segment = (marker: number, data: number[]) => [0xff, marker, ...u16(data.length + 2), ...data];
const frame = (marker: number, width: number, height: number) =>
  segment(marker, [8, ...u16(height), ...u16(width), 3, 1, 0x22, 0, 2, 0x11, 1, 3, 0x11, 1]);
const jpeg = (...parts: number[][]) => Uint8Array.from([0xff, 0xd8, ...parts.flat()]);

describe('readPictureFile', () => {
  it('reads the size of PNG', () => {
    expect(readPictureFile(png(640, 480))).toEqual({ format: 'png', width: 640, height: 480 });
    expect(readPictureFile(png(0xffffffff, 1))).toMatchObject({ width: 0xffffffff });
    expect(readPictureFile(png(640, 480).subarray(0, 23))).toBe('truncated');
  });

  it('reads the size of baseline and progressive JPEG, after other segments and fill bytes', () => {
    const exif = segment(0xe1, [...frame(0xc0, 160, 120)]);
    const tables = segment(0xc4, [1, 2, 3]);
    for (const marker of [0xc0, 0xc1, 0xc2]) {
      const bytes = jpeg(exif, tables, [0xff, 0xff], frame(marker, 640, 480));
      expect(readPictureFile(bytes)).toEqual({ format: 'jpeg', width: 640, height: 480 });
    }
  });

  it('reports what is missing', () => {
    const whole = jpeg(segment(0xe0, [1, 2, 3]), frame(0xc0, 640, 480));
    for (let length = 3; length < 18; length++)
      expect(readPictureFile(whole.subarray(0, length))).toBe('truncated');
    expect(readPictureFile(jpeg([0xff, 0xda, 0, 2], frame(0xc0, 1, 1)))).toBe('unknown-format');
    expect(readPictureFile(jpeg([0xff, 0xe0, 0, 1]))).toBe('unknown-format');
    expect(readPictureFile(Uint8Array.from([0x47, 0x49, 0x46]))).toBe('unknown-format');
    expect(readPictureFile(new Uint8Array(0))).toBe('unknown-format');
  });

  it('reads any bytes, and always terminates', () => {
    const heads = fc.constantFrom(jpeg(), png(3, 2), jpeg(frame(0xc0, 9, 9)));
    fc.assert(
      fc.property(heads, fc.uint8Array({ maxLength: 200 }), fc.nat(300), (head, tail, cut) => {
        const bytes = Uint8Array.from([...head, ...tail]).subarray(0, cut);
        const file = readPictureFile(bytes);
        if (typeof file !== 'string') expect(file.width * file.height).toBeGreaterThanOrEqual(0);
      }),
      { seed: 5, numRuns: 2000 },
    );
  });
});
