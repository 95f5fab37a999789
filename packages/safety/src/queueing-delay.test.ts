import fc from 'fast-check';
import { expect, test } from 'vitest';
import { QueueingDelay } from './queueing-delay.ts';

/** Operator clock 5000 ms ahead, 40 ms of path. */
const OFFSET = -5000 + 40;
const sentAt = (ms: number) => ms - OFFSET;

test('waiting is the excess over the shortest transit time seen', () => {
  const delay = new QueueingDelay(10_000);
  expect(delay.observe(sentAt(0), 0)).toBe(0);
  expect(delay.observe(sentAt(20), 120)).toBe(100);
  expect(delay.observe(sentAt(140), 140)).toBe(0);
});

test('a message that is faster than all before moves the reference', () => {
  const delay = new QueueingDelay(10_000);
  delay.observe(sentAt(0), 30);
  expect(delay.observe(sentAt(20), 20)).toBe(0);
  expect(delay.observe(sentAt(40), 70)).toBe(30);
});

test('follows clocks that drift by 100 ppm for a day', () => {
  const delay = new QueueingDelay(10_000);
  let worst = 0;
  for (let t = 0; t < 86_400_000; t += 500) worst = Math.max(worst, delay.observe(t * (1 - 1e-4), t));
  expect(worst).toBeLessThanOrEqual(1.001);
});

test('recovers within the window from a clock that jumps back', () => {
  const delay = new QueueingDelay(10_000);
  delay.observe(sentAt(0), 0);
  const waits: [number, number][] = [];
  for (let t = 20; t <= 12_000; t += 20) waits.push([t, delay.observe(sentAt(t) - 3_600_000, t)]);
  expect(waits[0]?.[1]).toBe(3_600_000);
  expect(waits.filter(([t, wait]) => t >= 10_000 && wait > 0)).toEqual([]);
});

test('a timestamp from the future spoils one window and no more', () => {
  const delay = new QueueingDelay(10_000);
  delay.observe(sentAt(0) + 1e12, 0);
  expect(delay.observe(sentAt(20), 20)).toBe(1e12);
  for (let t = 40; t < 10_000; t += 20) delay.observe(sentAt(t), t);
  expect(delay.observe(sentAt(10_000), 10_000)).toBe(0);
});

test('silence is no evidence: what was held back for longer than the window is late', () => {
  const delay = new QueueingDelay(10_000);
  for (let t = 0; t < 1000; t += 20) delay.observe(sentAt(t), t);
  expect(delay.observe(sentAt(1000), 61_000)).toBe(60_000);
  // What is sent afterwards is not late.
  expect(delay.observe(sentAt(61_020), 61_020)).toBe(0);
});

test('accepts a longer path after one window', () => {
  const delay = new QueueingDelay(1000);
  for (let t = 0; t < 1000; t += 10) delay.observe(sentAt(t), t);
  expect(delay.observe(sentAt(800), 1000)).toBe(200);
  for (let t = 1010; t < 2000; t += 10) delay.observe(sentAt(t - 200), t);
  expect(delay.observe(sentAt(1800), 2000)).toBe(0);
});

test.each([
  [Number.NaN, 0],
  [0, Number.NaN],
  [Number.NEGATIVE_INFINITY, 0],
])('times %d, %d: late, and nothing is learnt', (sent, received) => {
  const delay = new QueueingDelay(1000);
  expect(delay.observe(sent, received)).toBe(Number.POSITIVE_INFINITY);
  expect(delay.observe(0, 40)).toBe(0);
  expect(delay.observe(10, 60)).toBe(10);
});

test('agrees with a plain minimum over the window, to a tenth of it', () => {
  const step = fc.record({ dt: fc.integer({ min: 0, max: 400 }), wait: fc.integer({ min: 0, max: 500 }) });
  fc.assert(
    fc.property(fc.array(step, { minLength: 1, maxLength: 60, size: 'max' }), (steps) => {
      const delay = new QueueingDelay(1000);
      const seen: { t: number; difference: number }[] = [];
      let t = 0;
      for (const { dt, wait } of steps) {
        t += dt;
        seen.push({ t, difference: wait });
        const got = wait - delay.observe(t - wait, t);
        const over = (ms: number) => Math.min(...seen.filter((s) => s.t > t - ms).map((s) => s.difference));
        expect(got).toBeLessThanOrEqual(over(900));
        expect(got).toBeGreaterThanOrEqual(over(1000));
      }
    }),
    { seed: 1, numRuns: 500 },
  );
});
