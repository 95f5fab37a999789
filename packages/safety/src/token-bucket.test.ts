import { expect, test } from 'vitest';
import { TokenBucket } from './token-bucket.ts';

function takes(bucket: TokenBucket, times: number, nowMs: number): number {
  let taken = 0;
  for (let i = 0; i < times; i++) if (bucket.take(nowMs)) taken++;
  return taken;
}

test('one second’s worth at once, then as it refills', () => {
  const bucket = new TokenBucket(100);
  expect(takes(bucket, 150, 0)).toBe(100);
  expect(takes(bucket, 5, 9)).toBe(0);
  expect(takes(bucket, 5, 10)).toBe(1);
  expect(takes(bucket, 50, 110)).toBe(10);
});

test('a long pause fills it no further than one second’s worth', () => {
  const bucket = new TokenBucket(10);
  takes(bucket, 10, 0);
  expect(takes(bucket, 100, 60_000)).toBe(10);
});

test('a clock that runs backwards fills nothing, and does not fill twice when it comes back', () => {
  const bucket = new TokenBucket(10);
  expect(takes(bucket, 20, 1000)).toBe(10);
  expect(takes(bucket, 5, 0)).toBe(0);
  expect(takes(bucket, 5, 1000)).toBe(0);
  expect(takes(bucket, 5, 1100)).toBe(1);
});

test('a clock that runs backwards takes no credit away', () => {
  const bucket = new TokenBucket(10);
  expect(takes(bucket, 4, 1000)).toBe(4);
  expect(takes(bucket, 20, 0)).toBe(6);
});
