import fc from 'fast-check';
import { expect, test } from 'vitest';
import { decodeBandwidth, decodeStreamSwitch, encodeBandwidth } from './bandwidth.ts';
import { ProtocolError } from './errors.ts';
import { readVectors } from './testing/vectors.ts';

const vectors = readVectors<{
  decode: { hex: string; bitsPerSecond?: number; error?: string }[];
  encode: { bitsPerSecond: number; hex: string }[];
}>('bandwidth');

test.each(vectors.decode)('decode %j', ({ hex, bitsPerSecond, error }) => {
  const bytes = new Uint8Array(Buffer.from(hex, 'hex'));
  if (error === undefined) {
    expect(decodeBandwidth(bytes)).toBe(bitsPerSecond);
    expect(decodeBandwidth(bytes.buffer)).toBe(bitsPerSecond);
  } else {
    expect(() => decodeBandwidth(bytes)).toThrow(
      expect.objectContaining({ name: 'ProtocolError', code: error }),
    );
  }
});

test.each(vectors.encode)('encode %j', ({ bitsPerSecond, hex }) => {
  expect(Buffer.from(encodeBandwidth(bitsPerSecond)).toString('hex')).toBe(hex);
});

test('a value that is not a number is no bandwidth', () => {
  expect(decodeBandwidth(encodeBandwidth(Number.NaN))).toBe(0);
});

test('round trip, also inside a larger buffer', () => {
  fc.assert(
    fc.property(fc.nat(0x7fffffff), fc.nat(8), (rate, offset) => {
      const room = new Uint8Array(offset + 9);
      room.set(encodeBandwidth(rate), offset);
      expect(decodeBandwidth(room.subarray(offset, offset + 4))).toBe(rate);
    }),
    { seed: 1 },
  );
});

test('any bytes give a rate or a ProtocolError', () => {
  fc.assert(
    fc.property(fc.uint8Array({ maxLength: 8, size: 'max' }), (bytes) => {
      try {
        expect(decodeBandwidth(bytes)).toBeGreaterThanOrEqual(0);
      } catch (error) {
        expect(error).toBeInstanceOf(ProtocolError);
      }
    }),
    { seed: 2, numRuns: 500 },
  );
});

test('start and stop', () => {
  expect(decodeStreamSwitch('start')).toBe('start');
  expect(decodeStreamSwitch('stop')).toBe('stop');
});

test.each(['', 'Start', 'stop ', 'pause', '{"type":"stop"}'])('refuses %j', (text) => {
  expect(() => decodeStreamSwitch(text)).toThrow(ProtocolError);
});
