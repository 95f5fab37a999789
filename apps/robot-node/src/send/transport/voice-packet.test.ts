import fc from 'fast-check';
import { expect, test } from 'vitest';
import { voicePacket } from './voice-packet.ts';

/** A fixed header: version 2, the timestamp 0x01020304. */
const header = (first: number) => new Uint8Array([first, 96, 0, 7, 1, 2, 3, 4, 0, 0, 0, 1]);

test('a packet has its timestamp and its payload', () => {
  const payload = new Uint8Array([1, 2, 3]);
  expect(voicePacket(header(0x80), 7, payload)).toEqual({ sequence: 7, timestamp: 0x01020304, payload });
});

test('padding is left out', () => {
  const packet = header(0xa0);
  expect(voicePacket(packet, 7, new Uint8Array([9, 8, 0, 2]))?.payload).toEqual(new Uint8Array([9, 8]));
  expect(voicePacket(packet, 7, new Uint8Array([0, 0, 3]))?.payload).toHaveLength(0);
  expect(voicePacket(packet, 7, new Uint8Array([0, 0, 4]))).toBe(null);
  expect(voicePacket(packet, 7, new Uint8Array([9, 0]))).toBe(null);
  expect(voicePacket(packet, 7, new Uint8Array(0))).toBe(null);
});

test('any bytes give a part of themselves, or nothing', () => {
  fc.assert(
    fc.property(fc.nat(255), fc.uint8Array({ maxLength: 300 }), (first, payload) => {
      const packet = voicePacket(header(first), 7, payload);
      if (packet === null) return;
      expect(payload.subarray(0, packet.payload.length)).toEqual(packet.payload);
    }),
  );
});
