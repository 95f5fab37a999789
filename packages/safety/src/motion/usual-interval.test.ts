import fc from 'fast-check';
import { expect, test } from 'vitest';
import { UsualInterval } from './usual-interval.ts';

/** Events at these intervals, ms. @returns the time of the last one */
function events(usual: UsualInterval, intervals: number[], fromMs = 0): number {
  let now = fromMs;
  for (const interval of intervals) {
    now += interval;
    usual.add(interval, now);
  }
  return now;
}

const steady = (intervalMs: number, count: number) => Array.from({ length: count }, () => intervalMs);

test('one delay counts until the next event', () => {
  const usual = new UsualInterval();
  const delayed = events(usual, [...steady(33, 40), 150]);
  expect(usual.at(delayed)).toBe(150);
  expect(usual.at(events(usual, [33], delayed))).toBe(33);
});

test('a lower rate is usual at once', () => {
  const usual = new UsualInterval();
  let now = events(usual, steady(33, 40));
  for (let i = 0; i < 10; i++) {
    now = events(usual, [400], now);
    expect(usual.at(now + 399)).toBe(400);
  }
});

test('events in bursts have their pauses', () => {
  const usual = new UsualInterval();
  let now = events(usual, [490, 5, 5, 490, 5, 5]);
  for (let i = 0; i < 10; i++) {
    now = events(usual, [490, 5, 5], now);
    expect(usual.at(now)).toBe(490);
  }
});

test('what was long ago is forgotten', () => {
  const usual = new UsualInterval();
  const now = events(usual, [300, 300]);
  expect(usual.at(now + 2000)).toBe(0);
  events(usual, [300, 300], now + 2000);
  usual.reset(now + 2600);
  expect(usual.at(now + 2600)).toBe(0);
});

test('it is one of the intervals, and no shorter than the last', () => {
  fc.assert(
    fc.property(fc.array(fc.integer({ min: 1, max: 400 }), { minLength: 2, maxLength: 80 }), (intervals) => {
      const usual = new UsualInterval();
      let now = 0;
      for (const [i, interval] of intervals.entries()) {
        now = events(usual, [interval], now);
        const found = usual.at(now);
        expect(intervals.slice(0, i + 1)).toContain(found);
        expect(found).toBeGreaterThanOrEqual(interval);
      }
    }),
  );
});
