import { expect, test } from 'vitest';
import { AdaptiveThreshold } from './adaptive-threshold.ts';

/** The threshold after so long of an even trend, updated each 10 ms. */
function after(ms: number, magnitude: number, threshold = new AdaptiveThreshold()): AdaptiveThreshold {
  for (let now = 0; now <= ms; now += 10) threshold.update(magnitude, now);
  return threshold;
}

test('begins at 12.5 and comes down where the trend is low, to 6 and no lower', () => {
  expect(new AdaptiveThreshold().value).toBe(12.5);
  expect(after(10, 0).value).toBeCloseTo(12.5 * (1 - 0.39));
  expect(after(1000, 0).value).toBe(6);
});

test('goes up with a higher trend, more slowly', () => {
  expect(after(10, 20).value).toBeCloseTo(12.5 + 0.087 * 7.5);
  expect(after(1000, 20).value).toBeCloseTo(20, 1);
});

test('does not learn what lies more than 15 above it', () => {
  expect(after(1000, 27.6).value).toBe(12.5);
  expect(after(1000, 27.4).value).toBeGreaterThan(20);
});

test('never above 600', () => {
  const threshold = new AdaptiveThreshold();
  for (let i = 0; i < 20_000; i++) threshold.update(Math.min(threshold.value + 14, 700), i * 10);
  expect(threshold.value).toBe(600);
});

test('a pause counts as 100 ms', () => {
  const [short, long] = [100, 10_000].map((ms) => {
    const threshold = new AdaptiveThreshold();
    threshold.update(20, 0);
    threshold.update(20, ms);
    return threshold.value;
  });
  expect(long).toBe(short);
});
