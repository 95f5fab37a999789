import fc from 'fast-check';
import { expect, test } from 'vitest';
import { CapacityError, CapacitySchedule, type CapacitySpec, constantCapacity } from './capacity.ts';
import { parseTrace } from './trace.ts';

const steps: CapacitySpec = {
  steps: [
    { atMs: 0, mbps: 10 },
    { atMs: 100, mbps: 0 },
    { atMs: 300, mbps: 2 },
  ],
  periodMs: null,
};

test('a schedule integrates its steps, holds the last, and applies the first before its start', () => {
  const schedule = new CapacitySchedule(steps, 1000);
  expect(schedule.bitsBetween(1000, 1400)).toBe(100 * 10_000 + 100 * 2000);
  expect(schedule.bitsBetween(5000, 5010)).toBe(20_000);
  expect(schedule.bitsBetween(900, 1000)).toBe(1_000_000);
});

test('a schedule with a period repeats', () => {
  const schedule = new CapacitySchedule({ ...steps, periodMs: 400 }, 50);
  const once = schedule.bitsBetween(50, 450);
  expect(once).toBe(1_200_000);
  expect(schedule.bitsBetween(50 + 400 * 7, 50 + 400 * 10)).toBeCloseTo(3 * once, 3);
});

test('an outage serves nothing while it lasts', () => {
  const spec = { ...constantCapacity(8), outages: [{ startMs: 100, endMs: 250 }] };
  const schedule = new CapacitySchedule(spec, 0);
  expect(schedule.bitsBetween(0, 1000)).toBe(850 * 8000);
  expect(schedule.bitsBetween(120, 240)).toBe(0);
});

test('an interval is the sum of its parts, in whatever order it is queried', () => {
  const spec = fc.record({
    gaps: fc.array(
      fc.record({ ms: fc.integer({ min: 1, max: 500 }), mbps: fc.constantFrom(0, 0.002, 1, 41.44, 200) }),
      {
        minLength: 1,
        maxLength: 20,
      },
    ),
    loop: fc.boolean(),
    origin: fc.integer({ min: -1000, max: 1000 }),
    cuts: fc.array(fc.double({ min: -2000, max: 20_000, noNaN: true }), { minLength: 3, maxLength: 3 }),
  });
  fc.assert(
    fc.property(spec, ({ gaps, loop, origin, cuts }) => {
      let atMs = 0;
      const list = gaps.map(({ ms, mbps }) => {
        const step = { atMs, mbps };
        atMs += ms;
        return step;
      });
      const schedule = new CapacitySchedule({ steps: list, periodMs: loop ? atMs : null }, origin);
      const [a, b, c] = cuts.sort((x, y) => x - y) as [number, number, number];
      const late = schedule.bitsBetween(b, c);
      expect(schedule.bitsBetween(a, b) + late).toBeCloseTo(schedule.bitsBetween(a, c), 0);
    }),
    { seed: 1 },
  );
});

test.each([
  [{ steps: [], periodMs: null }, 'at least one step'],
  [{ steps: [{ atMs: 0, mbps: -1 }], periodMs: null }, 'is not 0 or more'],
  [
    {
      steps: [
        { atMs: 5, mbps: 1 },
        { atMs: 5, mbps: 1 },
      ],
      periodMs: null,
    },
    'is not after',
  ],
  [{ steps: [{ atMs: 5, mbps: 1 }], periodMs: 5 }, 'does not end after'],
  [{ ...constantCapacity(1), outages: [{ startMs: 3, endMs: 3 }] }, 'is empty'],
])('refuses an invalid schedule: %j', (spec, words) => {
  expect(() => new CapacitySchedule(spec, 0)).toThrow(words);
});

test('reads a trace with comments and header, which repeats one sample after its last', () => {
  const text = '# measured\ntime_s,capacity_mbps\n0.0,75.467\n0.1,0.000\r\n0.2,3\n';
  expect(parseTrace(text)).toEqual({
    steps: [
      { atMs: 0, mbps: 75.467 },
      { atMs: 100, mbps: 0 },
      { atMs: 200, mbps: 3 },
    ],
    periodMs: 300,
  });
  expect(parseTrace(text, 'hold').periodMs).toBeNull();
});

test('any text gives a usable schedule or a typed error', () => {
  const line = fc.oneof(
    fc.string(),
    fc.tuple(fc.double(), fc.double()).map((pair) => pair.join(',')),
    fc.tuple(fc.integer({ min: 0, max: 99 }), fc.nat()).map((pair) => pair.join(',')),
  );
  fc.assert(
    fc.property(fc.array(line), (lines) => {
      try {
        new CapacitySchedule(parseTrace(lines.join('\n')), 0);
      } catch (error) {
        expect(error).toBeInstanceOf(CapacityError);
      }
    }),
    { seed: 2 },
  );
});
