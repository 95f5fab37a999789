import type { RawPicture } from '@farpoint/cloud-source';
import { PictureCodec } from '@farpoint/pictures';
import { readPictureFile } from '@farpoint/protocol';
import { encode as encodePng } from 'fast-png';
import { beforeAll, describe, expect, it } from 'vitest';
import { PictureLossError, PictureMaker } from './picture-maker.ts';

const plan = { perSecond: 10, longestSide: 64, quality: 80, mostFileBytes: 8000, mostFileSide: 64 };
const raw = (width: number, height: number): RawPicture => ({
  ...{ kind: 'raw', width, height, step: width * 3, encoding: 'bgr8', bigEndian: false },
});
/** Orange, as B, G, R. */
const orange = (pixels: number) =>
  Uint8Array.from({ length: pixels * 3 }, (_, i) => [20, 120, 230][i % 3] as number);

let codec: PictureCodec;
let maker: PictureMaker;
beforeAll(async () => {
  codec = await PictureCodec.load();
  maker = new PictureMaker(codec);
});

function lossOf(act: () => unknown): string {
  try {
    act();
  } catch (error) {
    if (error instanceof PictureLossError) return error.reason;
    throw error;
  }
  return 'none';
}

describe('PictureMaker', () => {
  it('makes a JPEG from pixels, shrunk by a whole factor', () => {
    const made = maker.make({ facts: raw(160, 90), data: orange(160 * 90) }, plan);
    expect(made).toMatchObject({ format: 'jpeg', width: 53, height: 30, untouched: false });
    expect(readPictureFile(made.bytes)).toEqual({ format: 'jpeg', width: 53, height: 30 });
    const { rgba } = codec.decode('jpeg', made.bytes, 10_000);
    for (const [channel, value] of [230, 120, 20].entries())
      expect(Math.abs((rgba[channel] as number) - value)).toBeLessThan(6);
  });

  it('keeps a file that fits, and otherwise re-encodes it', () => {
    const pixels = { width: 64, height: 48, rgba: new Uint8Array(64 * 48 * 4).fill(99) };
    const jpeg = codec.encodeJpeg(pixels, 90);
    const facts = { kind: 'file', format: 'jpeg', width: 64, height: 48 } as const;
    expect(maker.make({ facts, data: jpeg }, plan)).toMatchObject({ bytes: jpeg, untouched: true });
    const smaller = maker.make({ facts, data: jpeg }, { ...plan, longestSide: 32, mostFileSide: 32 });
    expect(smaller).toMatchObject({ format: 'jpeg', width: 32, height: 24, untouched: false });
    const tight = maker.make({ facts, data: jpeg }, { ...plan, mostFileBytes: jpeg.length - 1 });
    expect(tight).toMatchObject({ width: 64, untouched: false });
    const png = encodePng({ width: 64, height: 48, data: pixels.rgba, channels: 4, depth: 8 });
    const ofPng = maker.make(
      { facts: { ...facts, format: 'png' }, data: Uint8Array.from(png) },
      { ...plan, mostFileBytes: 10 },
    );
    expect(ofPng).toMatchObject({ format: 'jpeg', width: 64, untouched: false });
  });

  it('says why a picture is lost', () => {
    const data = orange(160 * 90);
    expect(lossOf(() => maker.make({ facts: { ...raw(160, 90), encoding: 'nv21' }, data }, plan))).toBe(
      'unsupported',
    );
    expect(lossOf(() => maker.make({ facts: raw(160, 91), data }, plan))).toBe('bad-image');
    expect(lossOf(() => maker.make({ facts: raw(9000, 9000), data }, plan))).toBe('too-large');
    const facts = { kind: 'file', format: 'jpeg', width: 640, height: 480 } as const;
    expect(lossOf(() => maker.make({ facts, data: Uint8Array.from([0xff, 0xd8, 0xff, 0]) }, plan))).toBe(
      'unreadable',
    );
    const noise = Uint8Array.from(
      { length: 2000 * 1000 * 3 },
      (_, i) => (i * i * 7919 + (i >> 3) * 31) & 0xff,
    );
    const huge = { ...plan, longestSide: 4096, quality: 95 };
    expect(lossOf(() => maker.make({ facts: raw(2000, 1000), data: noise }, huge))).toBe('too-large');
  });
});
