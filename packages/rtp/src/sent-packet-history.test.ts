import fc from 'fast-check';
import { expect, test } from 'vitest';
import { SentPacketHistory } from './sent-packet-history.ts';

test('returns what was sent, once', () => {
  const history = new SentPacketHistory(16);
  history.add(65_535, 1244, 10.5);
  history.add(0, 300, 11);
  expect(history.take(65_535, 50)).toEqual({ bytes: 1244, sentMs: 10.5 });
  expect(history.take(65_535, 50)).toBeNull();
  expect(history.take(0, 50)).toEqual({ bytes: 300, sentMs: 11 });
});

test('does not find what was never sent', () => {
  expect(new SentPacketHistory(16).take(0, 0)).toBeNull();
});

test('does not find a packet from before the numbers wrapped', () => {
  const history = new SentPacketHistory(16, 5000);
  history.add(3, 100, 0);
  expect(history.take(3, 5001)).toBeNull();
});

test.each([0, 3, 131_072, -2])('refuses capacity %i', (capacity) => {
  expect(() => new SentPacketHistory(capacity)).toThrow(RangeError);
});

test('finds exactly the last `capacity` packets of any run', () => {
  fc.assert(
    fc.property(fc.nat(0xffff), fc.integer({ min: 1, max: 200 }), (first, count) => {
      const history = new SentPacketHistory(64);
      for (let i = 0; i < count; i++) history.add((first + i) & 0xffff, 1000 + i, i);
      for (let i = 0; i < count; i++) {
        const kept = i >= count - 64;
        expect(history.take((first + i) & 0xffff, count)).toEqual(
          kept ? { bytes: 1000 + i, sentMs: i } : null,
        );
      }
    }),
    { seed: 1 },
  );
});
