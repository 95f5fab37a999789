import { expect, test } from 'vitest';
import { Backoff } from './backoff.ts';

test('doubles up to its limit, continues there without end, and restarts after success', () => {
  const backoff = new Backoff({ firstMs: 500, mostMs: 10_000, random: () => 0.5 });
  expect(Array.from({ length: 7 }, () => backoff.nextMs())).toEqual([
    500, 1000, 2000, 4000, 8000, 10_000, 10_000,
  ]);
  for (let i = 0; i < 2000; i++) backoff.nextMs();
  expect(backoff.nextMs()).toBe(10_000);
  backoff.reset();
  expect(backoff.nextMs()).toBe(500);
});

test('is spread by ±25 %', () => {
  expect(new Backoff({ firstMs: 1000, mostMs: 1000, random: () => 0 }).nextMs()).toBe(750);
  expect(new Backoff({ firstMs: 1000, mostMs: 1000, random: () => 1 }).nextMs()).toBe(1250);
});
