import { describe, expect, test } from 'vitest';
import { AutoRange } from './auto-range.ts';

function fill(range: AutoRange, value: (i: number) => number, count = 512): void {
  for (let i = 0; i < count; i++) range.add(value(i));
}

describe('AutoRange', () => {
  test('applies its first range at once and leaves outliers out', () => {
    const range = new AutoRange();
    fill(range, (i) => (i === 7 ? 1000 : i === 300 ? -1000 : (i % 100) / 50));
    range.update(0, 0.5);
    expect(range.min).toBeGreaterThanOrEqual(0);
    expect(range.min).toBeLessThan(0.1);
    expect(range.max).toBeGreaterThan(1.9);
    expect(range.max).toBeLessThanOrEqual(2);
  });

  test('follows a change slowly', () => {
    const range = new AutoRange();
    fill(range, (i) => i % 2);
    range.update(0, 0.5);
    fill(range, (i) => 10 + (i % 2));
    range.update(250, 0.5);
    expect(range.max).toBeGreaterThan(1.5);
    expect(range.max).toBeLessThan(4);
    for (let ms = 500; ms < 10_000; ms += 250) range.update(ms, 0.5);
    expect(range.min).toBeCloseTo(10, 1);
    expect(range.max).toBeCloseTo(11, 1);
  });

  test('is never narrower than the least span, and around the values', () => {
    const range = new AutoRange();
    fill(range, () => 3);
    range.update(0, 0.5);
    expect([range.min, range.max]).toEqual([2.75, 3.25]);
  });

  test('keeps its range until there are enough samples, and begins anew after a reset', () => {
    const range = new AutoRange();
    fill(range, () => 5, 31);
    range.update(0, 1);
    expect([range.min, range.max]).toEqual([0, 1]);
    fill(range, (i) => i % 2);
    range.update(1, 1);
    range.reset(3, 4);
    range.update(2, 1);
    expect([range.min, range.max]).toEqual([3, 4]);
    fill(range, (i) => 50 + (i % 2));
    range.update(2, 1);
    expect([range.min, range.max]).toEqual([50, 51]);
  });
});
