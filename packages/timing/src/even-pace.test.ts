import fc from 'fast-check';
import { expect, test } from 'vitest';
import { EvenPace } from './even-pace.ts';

function taken(timesMs: readonly number[], intervalMs: number): number[] {
  const pace = new EvenPace();
  return timesMs.filter((ms) => {
    const takes = pace.takes(ms, intervalMs);
    if (takes) pace.taken(ms, intervalMs);
    return takes;
  });
}

const every = (ms: number, count: number) => Array.from({ length: count }, (_, i) => i * ms);

test('of twice as many, every other', () => {
  expect(taken(every(25, 9), 50)).toEqual([0, 50, 100, 150, 200]);
});

test('of 60/s, 40/s', () => {
  expect([80, 81]).toContain(taken(every(1000 / 60, 121), 25).length);
});

test('what comes at the wanted rate is all taken, although it jitters by a third of an interval', () => {
  const jitter = fc.array(fc.double({ min: -1 / 6, max: 1 / 6, noNaN: true }), {
    minLength: 2,
    maxLength: 100,
  });
  fc.assert(
    fc.property(jitter, (offsets) => {
      const times = offsets.map((offset, i) => (i + offset) * 33);
      expect(taken(times, 33)).toEqual(times);
    }),
    { seed: 7 },
  );
});

test('what comes more slowly than wanted is all taken', () => {
  const waits = fc.array(fc.integer({ min: 25, max: 500 }), { minLength: 2, maxLength: 100 });
  fc.assert(
    fc.property(waits, (all) => {
      let now = 0;
      const times = all.map((wait) => (now += wait));
      expect(taken(times, 25)).toEqual(times);
    }),
    { seed: 7 },
  );
});

test('after a pause, at most one is made up for', () => {
  const passed = taken([0, 100, ...every(10, 40).map((ms) => 5000 + ms)], 100);
  expect(passed.filter((ms) => ms >= 5000 && ms < 5100).length).toBeLessThanOrEqual(3);
  expect(taken([0, ...every(10, 101).map((ms) => 5000 + ms)], 100).length).toBeLessThanOrEqual(13);
});

test('after a reset, whatever comes next is due', () => {
  const pace = new EvenPace();
  pace.taken(0, 100);
  expect(pace.takes(10, 100)).toBe(false);
  pace.reset();
  expect(pace.takes(10, 100)).toBe(true);
});
