import fc from 'fast-check';
import { expect, it } from 'vitest';
import { isKeyPicture } from './recorded-videos.ts';

const nal = (type: number, ...rest: number[]) => [0, 0, 0, 1, 0x60 | type, ...rest];

it.each([
  [
    'an IDR slice behind its parameter sets',
    [...nal(9, 0xf0), ...nal(7, 1, 2), ...nal(8, 3), ...nal(5, 4)],
    true,
  ],
  ['a slice of another picture', [...nal(9, 0xf0), ...nal(1, 4)], false],
  ['parameter sets alone', [...nal(7, 1, 2), ...nal(8, 3)], false],
  ['a start code of three bytes', [0, 0, 1, 0x65, 9], true],
  ['a start code at the very end', [1, 2, 0, 0, 1], false],
  ['nothing', [], false],
])('H.264: %s', (_, bytes, key) => {
  expect(isKeyPicture('h264', Uint8Array.from(bytes))).toBe(key);
});

it.each([
  [[0x10, 0, 0, 0x9d, 0x01, 0x2a], true],
  [[0x11, 0, 0], false],
  [[], false],
])('VP8: %j', (bytes, key) => {
  expect(isKeyPicture('vp8', Uint8Array.from(bytes))).toBe(key);
});

it('takes any bytes', () => {
  fc.assert(
    fc.property(fc.constantFrom('h264' as const, 'vp8' as const), fc.uint8Array(), (coding, bytes) => {
      expect(typeof isKeyPicture(coding, bytes)).toBe('boolean');
    }),
  );
});
