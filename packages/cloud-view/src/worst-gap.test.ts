import { expect, test } from 'vitest';
import { WorstGap } from './worst-gap.ts';

test('a late call counts for about a second', () => {
  const gaps = new WorstGap();
  for (let now = 10_000; now <= 12_000; now += 25) gaps.measure(now);
  expect(gaps.at(12_000)).toBe(25);
  gaps.measure(12_140);
  for (let now = 12_165; now <= 12_600; now += 25) gaps.measure(now);
  expect(gaps.at(12_600)).toBe(140);
  for (let now = 12_625; now <= 14_000; now += 25) gaps.measure(now);
  expect(gaps.at(14_000)).toBe(25);
});

test('a page that was hidden was not late', () => {
  const gaps = new WorstGap();
  gaps.measure(1000);
  gaps.pause();
  gaps.measure(60_000);
  gaps.measure(60_025);
  expect(gaps.at(60_025)).toBe(25);
});
