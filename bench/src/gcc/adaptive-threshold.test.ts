import { expect, test } from 'vitest';
import { AdaptiveThreshold } from './adaptive-threshold.ts';

/** The threshold after `ms` of a constant trend, updated every 10 ms. */
function after(ms: number, magnitude: number, threshold = new AdaptiveThreshold()): AdaptiveThreshold {
  for (let now = 0; now <= ms; now += 10) threshold.update(magnitude, now);
  return threshold;
}

test('starts at 12.5 and falls with a low trend, to no less than 6', () => {
  expect(new AdaptiveThreshold().value).toBe(12.5);
  expect(after(10, 0).value).toBeCloseTo(12.5 * (1 - 0.39));
  expect(after(1000, 0).value).toBe(6);
});

test('rises with a higher trend, more slowly', () => {
  expect(after(10, 20).value).toBeCloseTo(12.5 + 0.087 * 7.5);
  expect(after(1000, 20).value).toBeCloseTo(20, 1);
});

test('ignores trends more than 15 above it', () => {
  expect(after(1000, 27.6).value).toBe(12.5);
  expect(after(1000, 27.4).value).toBeGreaterThan(20);
});

test('never exceeds 600', () => {
  const threshold = new AdaptiveThreshold();
  for (let i = 0; i < 20_000; i++) threshold.update(Math.min(threshold.value + 14, 700), i * 10);
  expect(threshold.value).toBe(600);
});

test('counts a pause as 100 ms', () => {
  const [short, long] = [100, 10_000].map((ms) => {
    const threshold = new AdaptiveThreshold();
    threshold.update(20, 0);
    threshold.update(20, ms);
    return threshold.value;
  });
  expect(long).toBe(short);
});
