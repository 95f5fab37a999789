import fc from 'fast-check';
import { expect, test } from 'vitest';
import { Quantiles } from './quantiles.ts';

function of(values: readonly number[]): Quantiles {
  const quantiles = new Quantiles();
  for (const value of values) quantiles.add(value);
  return quantiles;
}

test('quantiles are within one percent of the exact ones, by nearest rank', () => {
  const samples = fc.array(fc.double({ min: 0.01, max: 1e8, noNaN: true }), { minLength: 1, maxLength: 200 });
  fc.assert(
    fc.property(samples, (values) => {
      const sorted = [...values].sort((a, b) => a - b);
      const exact = (share: number) => sorted[Math.ceil(share * sorted.length) - 1] as number;
      const summary = of(values).summary();
      expect(summary).toMatchObject({ count: values.length, max: sorted.at(-1) });
      for (const [found, wanted] of [
        [summary?.p50, exact(0.5)],
        [summary?.p95, exact(0.95)],
      ] as const)
        expect(Math.abs((found ?? 0) / wanted - 1)).toBeLessThan(0.0101);
    }),
  );
});

test('what is no number is no sample; what is small or large has its place', () => {
  expect(of([]).summary()).toBeNull();
  expect(of([Number.NaN, Number.POSITIVE_INFINITY]).summary()).toBeNull();
  expect(of([0, 0, 0]).summary()).toEqual({ count: 3, mean: 0, p50: 0, p95: 0, max: 0 });
  expect(of([-3, -3]).summary()).toMatchObject({ p50: -3, p95: -3, max: -3 });
  expect(of([1e12]).summary()).toMatchObject({ p50: 1e12, max: 1e12 });
  expect(of([1, 2, 3]).summary()?.mean).toBe(2);
});
