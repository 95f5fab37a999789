import { expect, test } from 'vitest';
import { nextRtpTimestamp, rtpTimestamp } from './rtp-timestamp.ts';

test.each([
  [0, 90_000, 0],
  [1000, 90_000, 90_000],
  [0.5, 48_000, 24],
  [(2 ** 32 / 48_000) * 1000 + 1000, 48_000, 48_000],
])('%f ms at %i Hz is %i', (atMs, clockRate, timestamp) => {
  expect(rtpTimestamp(atMs, clockRate)).toBe(timestamp);
});

test('the next tick, over the wrap', () => {
  expect([0, 2 ** 31 - 1, 2 ** 32 - 1].map(nextRtpTimestamp)).toEqual([1, 2 ** 31, 0]);
});
