import { expect, test } from 'vitest';
import { rtpTimestamp } from './rtp-timestamp.ts';

test.each([
  [0, 90_000, 0],
  [1000, 90_000, 90_000],
  [0.5, 48_000, 24],
  [(2 ** 32 / 48_000) * 1000 + 1000, 48_000, 48_000],
])('%f ms at %i Hz is %i', (atMs, clockRate, timestamp) => {
  expect(rtpTimestamp(atMs, clockRate)).toBe(timestamp);
});
