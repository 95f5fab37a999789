import fc from 'fast-check';
import { expect, test } from 'vitest';
import { ageOfStampMs, ClockOffset, stampUsOf } from './clock-offset.ts';

/** Robot clock 5000 ms ahead of the operator's. */
function probe(clock: ClockOffset, sentMs: number, thereMs: number, backMs: number): void {
  const answer = { type: 'clockAnswer', id: 0, sentMs, robotMs: sentMs + thereMs + 5000 } as const;
  clock.add(answer, sentMs + thereMs + backMs);
}

test('nothing is known before the first answer', () => {
  const clock = new ClockOffset();
  expect([clock.offsetMs, clock.minRttMs, clock.lastRttMs]).toEqual([null, null, null]);
});

test('a symmetric path gives the exact offset', () => {
  const clock = new ClockOffset();
  probe(clock, 100, 20, 20);
  expect([clock.offsetMs, clock.minRttMs, clock.lastRttMs]).toEqual([5000, 40, 40]);
});

test('uses the shortest round trip, reports the latest', () => {
  const clock = new ClockOffset();
  probe(clock, 0, 20, 20);
  probe(clock, 100, 20, 320);
  expect([clock.offsetMs, clock.minRttMs, clock.lastRttMs]).toEqual([5000, 40, 340]);
});

test('takes the quickest way of each direction, also of different probes', () => {
  const clock = new ClockOffset();
  probe(clock, 0, 2, 50);
  expect(clock.offsetMs).toBe(4976);
  probe(clock, 100, 30, 2);
  expect(clock.offsetMs).toBe(5000);
  expect(clock.minRttMs).toBe(32);
});

test('of probes that contradict each other, because a clock drifts, the shortest counts alone', () => {
  const clock = new ClockOffset();
  probe(clock, 0, 20, 20);
  clock.add({ type: 'clockAnswer', id: 0, sentMs: 500, robotMs: 500 + 5060 }, 530);
  expect(clock.offsetMs).toBe(5045);
});

test('only the last probes count', () => {
  const clock = new ClockOffset(2);
  probe(clock, 0, 1, 1);
  expect(clock.settled).toBe(false);
  probe(clock, 100, 20, 20);
  expect(clock.settled).toBe(true);
  probe(clock, 200, 30, 30);
  expect(clock.minRttMs).toBe(40);
});

test('ignores an answer dated before its question', () => {
  const clock = new ClockOffset();
  clock.add({ type: 'clockAnswer', id: 0, sentMs: 100, robotMs: 7 }, 99);
  expect(clock.offsetMs).toBeNull();
});

test('the error is at most half the shortest round trip', () => {
  const delay = fc.double({ min: 0, max: 500, noNaN: true });
  fc.assert(
    fc.property(fc.array(fc.tuple(delay, delay), { minLength: 1, maxLength: 40, size: 'max' }), (ways) => {
      const clock = new ClockOffset();
      ways.forEach(([there, back], i) => void probe(clock, i * 1000, there, back));
      expect(Math.abs((clock.offsetMs as number) - 5000)).toBeLessThanOrEqual(
        (clock.minRttMs as number) / 2 + 1e-6,
      );
    }),
    { seed: 1, numRuns: 300 },
  );
});

test('a stamp wraps after 2³² µs', () => {
  expect([0, 1.2509, 4_294_967.295, 4_294_967.296, 4_294_968.3].map(stampUsOf)).toEqual([
    0,
    1250,
    2 ** 32 - 1,
    0,
    1004,
  ]);
});

test('the age of a timestamp, across its wrap and slightly negative', () => {
  const wrapMs = 2 ** 32 / 1000;
  expect(ageOfStampMs(1_000_000, 1250)).toBe(250);
  expect(ageOfStampMs(1_000_000, 1250 + wrapMs * 1000)).toBeCloseTo(250, 1);
  expect(ageOfStampMs(2 ** 32 - 1000, wrapMs + 2)).toBeCloseTo(3, 2);
  expect(ageOfStampMs(1000, wrapMs * 3 - 1)).toBeCloseTo(-2, 2);
});
