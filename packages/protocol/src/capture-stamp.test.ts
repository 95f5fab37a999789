import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { captureStampNal, readCaptureStamp, writeCaptureStamp } from './capture-stamp.ts';
import { readVectors } from './testing/vectors.ts';
import type { VideoCodec } from './video-media.ts';

const vectors = readVectors<{
  write: { name: string; nanoseconds: string; hex: string }[];
  read: { name: string; codec: VideoCodec; hex: string; nanoseconds?: string }[];
}>('capture-stamp');
const bytesOf = (hex: string) => Uint8Array.from(Buffer.from(hex, 'hex'));

describe('conformance vectors', () => {
  test.each(vectors.write)('write: $name', ({ nanoseconds, hex }) => {
    expect(Buffer.from(writeCaptureStamp(BigInt(nanoseconds))).toString('hex')).toBe(hex);
  });

  test.each(vectors.read)('read: $name', ({ codec, hex, nanoseconds }) => {
    const expected = nanoseconds === undefined ? null : BigInt(nanoseconds);
    expect(readCaptureStamp(bytesOf(hex), codec)).toBe(expected);
  });
});

test('the NAL unit is the one that is read, and has no byte that an encoder must escape', () => {
  fc.assert(
    fc.property(fc.bigInt({ min: 0n, max: (1n << 64n) - 1n }), (captureNs) => {
      const nal = captureStampNal(captureNs);
      expect(nal.every((byte) => byte > 3)).toBe(true);
      expect(readCaptureStamp(Uint8Array.of(0, 0, 0, 1, ...nal, 0, 0, 1, 0x65), 'H264')).toBe(captureNs);
    }),
    { seed: 1 },
  );
});

test('any bytes give a time or none', () => {
  fc.assert(
    fc.property(fc.uint8Array({ maxLength: 80 }), fc.constantFrom('H264', 'VP8'), (bytes, codec) => {
      expect(readCaptureStamp(bytes, codec as VideoCodec)).toBe(null);
    }),
    { seed: 1 },
  );
});
