import { describe, expect, test } from 'vitest';
import { type BandwidthUsage, OveruseDetector } from './overuse-detector.ts';

/** The detector's results for these slopes, with groups of `sentDeltaMs` each. */
function usages(slopes: readonly number[], sentDeltaMs = 10): BandwidthUsage[] {
  const detector = new OveruseDetector();
  return slopes.map((slope, i) => {
    detector.update(slope, 100 + i, sentDeltaMs, i * sentDeltaMs);
    return detector.usage;
  });
}

describe('over-use', () => {
  // 60 groups times a gain of 4 times 0.08 is 19, which is above 12.5.
  test('is a slope above the threshold for more than 10 ms', () => {
    expect(usages([0.08, 0.08, 0.08])).toEqual(['normal', 'over', 'over']);
    expect(usages([0.08, 0.08, 0.08], 5)).toEqual(['normal', 'normal', 'over']);
  });

  test('is not reported for a falling slope', () => {
    expect(usages([0.1, 0.09, 0.08])).toEqual(['normal', 'normal', 'normal']);
  });

  test('ends with the slope, and its duration restarts', () => {
    expect(usages([0.08, 0.08, 0.01, 0.08, 0.08])).toEqual(['normal', 'over', 'normal', 'normal', 'over']);
  });

  test('is not reported for a single group, however steep', () => {
    expect(usages([0, 0, 0.9, 0], 50)).toEqual(['normal', 'normal', 'normal', 'normal']);
  });
});

test('reports under-use for a slope below the negative threshold', () => {
  expect(usages([-0.08, -0.01])).toEqual(['under', 'normal']);
});

test('gives few groups little weight: the same slope means nothing on a path that is hardly known', () => {
  const detector = new OveruseDetector();
  for (let groups = 1; groups <= 15; groups++) detector.update(0.08, groups, 10, groups * 10);
  expect(detector.usage).toBe('normal');
});
