import { expect, test } from 'vitest';
import { clipTimes } from './clip-times.ts';

const at = (...seconds: number[]) => seconds.map((second) => ({ timestampUs: 7e6 + second * 1e6 }));

test('pictures are shown until the next one, and the last one for as long as usual', () => {
  expect(clipTimes(at(0, 0.1, 0.3), 50_000)).toEqual({
    shown: [
      { atS: 0, forS: 0.1 },
      { atS: 0.1, forS: 0.2 },
      { atS: 0.3, forS: 0.05 },
    ],
    seconds: 0.35,
    missingS: 0,
  });
  expect(clipTimes([], 50_000)).toEqual({ shown: [], seconds: 0, missingS: 0 });
});

test('what is missing is cut to a second, and told', () => {
  const { shown, seconds, missingS } = clipTimes(at(0, 1, 11, 11.5), 100_000);
  expect(shown.map(({ atS }) => atS)).toEqual([0, 1, 2, 2.5]);
  expect([seconds, missingS]).toEqual([2.6, 9]);
});
