import fc from 'fast-check';
import { expect, test } from 'vitest';
import { readAccessUnit } from './annex-b.ts';
import { standInPicture } from './stand-in-picture.ts';

const SPS = [0, 0, 0, 1, 0x67, 0x42, 0xe0, 0x1f, 0xda];
const PPS = [0, 0, 0, 1, 0x68, 0xce, 0x3c, 0x80];
const IDR = [0, 0, 1, 0x65, 0x88, 0x84];
const SLICE = [0, 0, 1, 0x41, 0x9a, 0x02];
const read = (...units: number[][]) => readAccessUnit(Uint8Array.from(units.flat()));

test('an IDR picture with parameter sets is a key frame, and tells its profile and level', () => {
  expect(read(SPS, PPS, IDR)).toEqual({ codec: 'avc1.42e01f', isKey: true });
  // After an access unit delimiter.
  expect(read([0, 0, 0, 1, 9, 0x10], SPS, PPS, IDR)).toEqual({ codec: 'avc1.42e01f', isKey: true });
});

test('without parameter sets, or with another slice, decoding cannot begin', () => {
  expect(read(IDR)).toEqual({ codec: null, isKey: false });
  expect(read(SPS, PPS, SLICE)).toEqual({ codec: 'avc1.42e01f', isKey: false });
  // A start code and nothing behind it.
  expect(read([0, 0, 1])).toEqual({ codec: null, isKey: false });
  expect(read([0, 0, 1, 0x67, 0x42])).toEqual({ codec: null, isKey: false });
});

test('looks no farther than the first slice', () => {
  expect(read(SLICE, SPS, PPS, IDR)).toEqual({ codec: null, isKey: false });
});

test('takes any bytes', () => {
  fc.assert(
    fc.property(fc.array(fc.constantFrom(0, 1, 0x65, 0x67, 0x41, 0xff), { maxLength: 64 }), (bytes) => {
      const { codec, isKey } = readAccessUnit(Uint8Array.from(bytes));
      expect(isKey).toBe(isKey && codec !== null);
      if (codec !== null) expect(codec).toMatch(/^avc1\.[0-9a-f]{6}$/);
    }),
  );
});

test('the picture for the browser’s own decoder needs no other', () => {
  expect(readAccessUnit(new Uint8Array(standInPicture('H264')))).toEqual({
    codec: 'avc1.42c015',
    isKey: true,
  });
  const vp8 = new Uint8Array(standInPicture('VP8'));
  // RFC 6386, section 9.1: a key frame's start code, 16 pixels by 16.
  expect([...vp8.slice(3, 10)]).toEqual([0x9d, 0x01, 0x2a, 16, 0, 16, 0]);
  // Each is the caller's own.
  expect(standInPicture('VP8')).not.toBe(standInPicture('VP8'));
});
