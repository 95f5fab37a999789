import fc from 'fast-check';
import { expect, test } from 'vitest';
import { TokenBucket } from './token-bucket.ts';

function takes(bucket: TokenBucket, times: number, nowMs: number): number {
  let taken = 0;
  for (let i = 0; i < times; i++) if (bucket.take(nowMs)) taken++;
  return taken;
}

test('one second’s worth at once, then as the bucket refills', () => {
  const bucket = new TokenBucket({ perSecond: 100 });
  expect(takes(bucket, 150, 0)).toBe(100);
  expect(takes(bucket, 5, 9)).toBe(0);
  expect(takes(bucket, 5, 10)).toBe(1);
  expect(takes(bucket, 50, 110)).toBe(10);
});

test('a long pause fills it no further than its burst', () => {
  const bucket = new TokenBucket({ perSecond: 10, burst: 25 });
  expect(takes(bucket, 100, 0)).toBe(25);
  expect(takes(bucket, 100, 60_000)).toBe(25);
});

test('rates whose interval is not a whole number of milliseconds add up exactly', () => {
  const bucket = new TokenBucket({ perSecond: 30, burst: 7 });
  expect(takes(bucket, 10, 0)).toBe(7);
  let taken = 0;
  for (let now = 1; now <= 10_000; now++) taken += takes(bucket, 1, now);
  expect(taken).toBe(300);
});

test('a clock that runs backwards adds nothing, and does not add twice when it returns', () => {
  const bucket = new TokenBucket({ perSecond: 10 });
  expect(takes(bucket, 20, 1000)).toBe(10);
  expect(takes(bucket, 5, 0)).toBe(0);
  expect(takes(bucket, 5, 1000)).toBe(0);
  expect(takes(bucket, 5, 1100)).toBe(1);
});

test('a clock that runs backwards removes no credit', () => {
  const bucket = new TokenBucket({ perSecond: 10 });
  expect(takes(bucket, 4, 1000)).toBe(4);
  expect(takes(bucket, 20, 0)).toBe(6);
});

test('never grants more than burst + rate × time, and always that much after a rest', () => {
  fc.assert(
    fc.property(fc.array(fc.integer({ min: 0, max: 300 }), { maxLength: 200 }), (gaps) => {
      const bucket = new TokenBucket({ perSecond: 10, burst: 5 });
      let now = 0;
      let taken = 0;
      for (const [index, gap] of gaps.entries()) {
        if (index > 0) now += gap;
        if (bucket.take(now)) taken++;
        expect(taken).toBeLessThanOrEqual(5 + (now * 10) / 1000);
      }
      now += 500;
      for (let i = 0; i < 5; i++) expect(bucket.take(now)).toBe(true);
    }),
    { seed: 3 },
  );
});

test('several tokens are taken together or not at all', () => {
  const bucket = new TokenBucket({ perSecond: 10 });
  expect(bucket.take(0, 8)).toBe(true);
  expect(bucket.take(0, 3)).toBe(false);
  expect(bucket.take(0, 2)).toBe(true);
  expect(bucket.take(0, 1)).toBe(false);
  expect(bucket.take(300, 3)).toBe(true);
});
