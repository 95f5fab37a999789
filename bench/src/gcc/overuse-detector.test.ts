import { describe, expect, test } from 'vitest';
import { type BandwidthUsage, OveruseDetector } from './overuse-detector.ts';

/** What it says after each of these slopes, each group standing for `sentDeltaMs`. */
function usages(slopes: readonly number[], sentDeltaMs = 10): BandwidthUsage[] {
  const detector = new OveruseDetector();
  return slopes.map((slope, i) => {
    detector.update(slope, 100 + i, sentDeltaMs, i * sentDeltaMs);
    return detector.usage;
  });
}

describe('over-use', () => {
  // 60 groups times a gain of 4 times 0.08 is 19: above 12.5.
  test('is a slope above the threshold for more than 10 ms', () => {
    expect(usages([0.08, 0.08, 0.08])).toEqual(['normal', 'over', 'over']);
    expect(usages([0.08, 0.08, 0.08], 5)).toEqual(['normal', 'normal', 'over']);
  });

  test('is not said of a slope that falls', () => {
    expect(usages([0.1, 0.09, 0.08])).toEqual(['normal', 'normal', 'normal']);
  });

  test('ends with the slope, and its time begins anew', () => {
    expect(usages([0.08, 0.08, 0.01, 0.08, 0.08])).toEqual(['normal', 'over', 'normal', 'normal', 'over']);
  });

  test('a single group is none, however steep', () => {
    expect(usages([0, 0, 0.9, 0], 50)).toEqual(['normal', 'normal', 'normal', 'normal']);
  });
});

test('a slope below the threshold’s negative is under-use', () => {
  expect(usages([-0.08, -0.01])).toEqual(['under', 'normal']);
});

test('few groups weigh little: the same slope says nothing of a path hardly known', () => {
  const detector = new OveruseDetector();
  for (let groups = 1; groups <= 15; groups++) detector.update(0.08, groups, 10, groups * 10);
  expect(detector.usage).toBe('normal');
});
