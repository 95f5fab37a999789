import { expect, test } from 'vitest';
import { distribution, quantile, rounded, timeCalls } from './stats.ts';

test('quantiles are interpolated between the values', () => {
  expect(quantile([1, 2, 3, 4], 0.5)).toBe(2.5);
  expect(quantile([1, 2, 3, 4], 0)).toBe(1);
  expect(quantile([1, 2, 3, 4], 1)).toBe(4);
  expect(quantile([7], 0.99)).toBe(7);
});

test('a distribution does not depend on the order of the values', () => {
  const values = Array.from({ length: 101 }, (_, i) => (i * 37) % 101);
  expect(distribution(values)).toEqual({ p50: 50, p95: 95, p99: 99, max: 100 });
});

test('gives no numbers without values', () => {
  expect(JSON.stringify(distribution([]))).toBe('{"p50":null,"p95":null,"p99":null,"max":null}');
});

test('rounding keeps the requested decimals', () => {
  expect(rounded({ p50: 1.23456, p95: 2, p99: 3.00049, max: 4.9996 })).toEqual({
    p50: 1.235,
    p95: 2,
    p99: 3,
    max: 5,
  });
});

test('only the rounds after the warm-up are timed', () => {
  const calls: number[] = [];
  expect(timeCalls((round) => calls.push(round), 3, 2)).toHaveLength(3);
  expect(calls).toEqual([0, 1, 0, 1, 2]);
});
