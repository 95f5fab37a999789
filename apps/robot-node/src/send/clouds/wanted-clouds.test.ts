import fc from 'fast-check';
import { expect, test } from 'vitest';
import { DisplayPace } from './wanted-clouds.ts';

function taken(pace: DisplayPace, timesMs: readonly number[], sensor = 0): number[] {
  return timesMs.filter((ms) => pace.takes(sensor, ms));
}
const every = (ms: number, count: number) => Array.from({ length: count }, (_, i) => 1000 + i * ms);

test('who has not said what its computer draws gets every cloud', () => {
  expect(taken(new DisplayPace(), every(16, 100))).toHaveLength(100);
});

test('a slower computer gets as many as it draws, evenly, and of each sensor', () => {
  const pace = new DisplayPace();
  pace.display = { framesPerSecond: 10, points: 1000 };
  const times = taken(pace, every(25, 400));
  expect([100, 101]).toContain(times.length);
  for (let i = 2; i < times.length; i++) expect((times[i] as number) - (times[i - 1] as number)).toBe(100);
  expect(taken(pace, every(25, 400), 1)).toEqual(times);
});

test('clouds at the rate that it draws all come, although their captures jitter', () => {
  const jitter = fc.array(fc.integer({ min: -15, max: 15 }), { minLength: 50, maxLength: 200 });
  fc.assert(
    fc.property(jitter, (offsets) => {
      const pace = new DisplayPace();
      pace.display = { framesPerSecond: 20, points: 1000 };
      const times = offsets.map((offset, i) => 1000 + i * 50 + offset);
      expect(taken(pace, times).length).toBeGreaterThanOrEqual(times.length - 1);
    }),
    { seed: 19 },
  );
});

test('whatever comes, never more than it draws for longer than a moment', () => {
  const waits = fc.array(fc.integer({ min: 1, max: 400 }), { minLength: 20, maxLength: 300 });
  fc.assert(
    fc.property(waits, fc.integer({ min: 1, max: 60 }), (all, framesPerSecond) => {
      const pace = new DisplayPace();
      pace.display = { framesPerSecond, points: 1000 };
      let now = 0;
      const times = all.map((wait) => (now += wait));
      const passed = taken(pace, times);
      const lastedS = ((times.at(-1) as number) - (times[0] as number)) / 1000;
      expect(passed.length).toBeLessThanOrEqual(lastedS * framesPerSecond + 2);
    }),
    { seed: 19 },
  );
});
