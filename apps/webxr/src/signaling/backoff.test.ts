import { expect, test } from 'vitest';
import { Backoff } from './backoff.ts';

test('doubles up to its limit, for ever, and begins anew after success', () => {
  const backoff = new Backoff(500, 10_000, () => 0.5);
  expect(Array.from({ length: 7 }, () => backoff.next())).toEqual([
    500, 1000, 2000, 4000, 8000, 10_000, 10_000,
  ]);
  for (let i = 0; i < 2000; i++) backoff.next();
  expect(backoff.next()).toBe(10_000);
  backoff.reset();
  expect(backoff.next()).toBe(500);
});

test('is spread by a quarter both ways', () => {
  expect(new Backoff(1000, 1000, () => 0).next()).toBe(750);
  expect(new Backoff(1000, 1000, () => 1).next()).toBe(1250);
});
