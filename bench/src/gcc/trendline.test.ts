import { Random } from '@farpoint/network-sim';
import { expect, test } from 'vitest';
import { Trendline } from './trendline.ts';

/** The slope after groups every 10 ms whose delay grows by `gradient` ms per ms. */
function slopeAfter(groups: number, gradient: number, noiseMs = 0): number {
  const trendline = new Trendline();
  const random = new Random(1, 0);
  let slope = 0;
  let lastMs = 0;
  for (let i = 1; i <= groups; i++) {
    const nowMs = i * 10 * (1 + gradient) + noiseMs * (random.next() - 0.5);
    slope = trendline.add(10, nowMs - lastMs, nowMs);
    lastMs = nowMs;
  }
  return slope;
}

test('gives no slope before its window of 20 groups is full', () => {
  expect(slopeAfter(19, 0.2)).toBe(0);
  expect(slopeAfter(20, 0.2)).toBeGreaterThan(0.05);
});

test.each([0, 0.01, 0.1, 0.5, -0.1, -0.3])('finds a gradient of %f', (gradient) => {
  // Per ms of arrival. The smoothing lags, but has caught up after 100 groups.
  expect(slopeAfter(100, gradient)).toBeCloseTo(gradient / (1 + gradient), 4);
});

test('is hardly moved by noise of ± 2 ms', () => {
  expect(Math.abs(slopeAfter(200, 0, 4))).toBeLessThan(0.01);
});

test('keeps its slope if all groups arrived at the same time', () => {
  const trendline = new Trendline();
  for (let i = 0; i < 40; i++) expect(trendline.add(10, 0, 500)).toBe(0);
});
