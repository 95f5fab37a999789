import fc from 'fast-check';
import { expect, test } from 'vitest';
import { opusDurationMs } from './opus-packet.ts';

const packet = (config: number, code: number, ...more: number[]) =>
  new Uint8Array([(config << 3) | code, ...more]);

test('the length follows from the first bytes (RFC 6716 §3)', () => {
  // SILK, hybrid and CELT, one frame.
  expect(opusDurationMs(packet(1, 0, 1, 2))).toBe(20);
  expect(opusDurationMs(packet(3, 0, 1))).toBe(60);
  expect(opusDurationMs(packet(12, 0, 1))).toBe(10);
  expect(opusDurationMs(packet(16, 0, 1))).toBe(2.5);
  expect(opusDurationMs(packet(31, 0))).toBe(20);
  // Two frames, of equal and of different sizes.
  expect(opusDurationMs(packet(31, 1, 1, 2))).toBe(40);
  expect(opusDurationMs(packet(31, 2, 1, 2))).toBe(40);
  // Any number.
  expect(opusDurationMs(packet(31, 3, 6, 1))).toBe(120);
});

test('what cannot be one is refused', () => {
  expect(opusDurationMs(new Uint8Array(0))).toBe(null);
  expect(opusDurationMs(packet(31, 1, 1))).toBe(null);
  expect(opusDurationMs(packet(31, 2))).toBe(null);
  expect(opusDurationMs(packet(31, 3))).toBe(null);
  expect(opusDurationMs(packet(31, 3, 0, 1))).toBe(null);
  expect(opusDurationMs(packet(31, 3, 7, 1))).toBe(null);
  expect(opusDurationMs(packet(3, 1, 1, 2))).toBe(120);
  expect(opusDurationMs(packet(3, 3, 3, 1))).toBe(null);
  expect(opusDurationMs(new Uint8Array(1300))).toBe(null);
});

test('any bytes have a length of at most 120 ms, or none', () => {
  fc.assert(
    fc.property(fc.uint8Array({ maxLength: 2000 }), (bytes) => {
      const durationMs = opusDurationMs(bytes);
      if (durationMs === null) return;
      expect(durationMs).toBeGreaterThan(0);
      expect(durationMs).toBeLessThanOrEqual(120);
    }),
  );
});
