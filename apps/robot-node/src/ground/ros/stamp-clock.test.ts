import { describe, expect, test } from 'vitest';
import { StampClock } from './stamp-clock.ts';

const DAY_MS = 1.7e12;
const YEARS_MS = -50 * 365 * 24 * 3600 * 1000;

/** A clock of this machine at which the monotonic one began at `DAY_MS`. */
function start() {
  let nowMs = 0;
  const clock = new StampClock({
    now: () => nowMs,
    wallNs: () => BigInt(Math.round((DAY_MS + nowMs) * 1e6)),
  });
  const ns = (ms: number) => BigInt(Math.round((DAY_MS + ms) * 1e6));
  return {
    /** What was captured then, by a clock that is ahead of ours, and how long it took to come. */
    arrives(atMs: number, delayMs: number, aheadMs = 0, topic = '/odom') {
      nowMs = atMs + delayMs;
      return clock.inOrder(topic, ns(atMs + aheadMs), nowMs);
    },
    anyOrder(atMs: number, receivedMs: number, localised = false) {
      nowMs = receivedMs;
      return clock.inAnyOrder('tf base_link', ns(atMs), nowMs, localised);
    },
    raw(stampNs: bigint, receivedMs: number, topic = '/odom') {
      nowMs = receivedMs;
      return clock.inOrder(topic, stampNs, nowMs);
    },
  };
}

describe('stamps of our own clock', () => {
  test('are taken at their word, however old', () => {
    const { arrives } = start();
    let t = 0;
    for (const delayMs of [0, 30, 450, 700, 2000, 5000, 60_000, 3_600_000]) {
      t += 7_200_000;
      expect(arrives(t, delayMs)).toBeCloseTo(t, 1);
    }
  });

  test('are never after their arrival, and refused where they are ahead by more than 100 ms', () => {
    const { arrives, anyOrder } = start();
    expect(arrives(1000, 0, 99)).toBe(1000);
    expect(arrives(2000, 0, 101)).toBe('ahead');
    expect(arrives(3000, 5, 24 * 3600 * 1000)).toBe('ahead');
    // Those that come after it count.
    expect(arrives(3100, 5)).toBeCloseTo(3100, 1);
    // Localisation says ahead of time where frames will be.
    expect(anyOrder(4100, 3200, true)).toBe(3200);
    expect([anyOrder(4100, 3200), anyOrder(9000, 3200, true)]).toEqual(['ahead', 'ahead']);
  });

  test('that step back are as old as they say', () => {
    const { arrives } = start();
    expect(arrives(100_000, 10)).toBeCloseTo(100_000, 1);
    for (let t = 100_100; t < 103_000; t += 100) expect(arrives(t, 10, -60_000)).toBeCloseTo(t - 60_000, 1);
    expect(arrives(103_000, 10)).toBeCloseTo(103_000, 1);
  });

  test.each([
    [999, 'repeated'],
    [1001, expect.closeTo(8999, 1)],
  ])('that go back by %i ms: their clock was set back if that is more than a second', (backMs, judged) => {
    const { arrives } = start();
    arrives(10_000, 10);
    expect(arrives(10_000, 110, -backMs)).toEqual(judged);
  });

  test('of a message that is not newer are refused, where the order counts', () => {
    const { arrives, anyOrder } = start();
    expect(arrives(1000, 10)).toBeCloseTo(1000, 1);
    expect([arrives(1000, 50), arrives(900, 200), arrives(0, 1100)]).toEqual([
      'repeated',
      'repeated',
      'repeated',
    ]);
    expect(arrives(900, 200, 0, '/other')).toBeCloseTo(900, 1);
    expect(anyOrder(1000, 1010)).toBeCloseTo(1000, 1);
    expect(anyOrder(990, 1020)).toBeCloseTo(990, 1);
  });
});

test('a source that never stamps counts as it arrives; one that has stamped must go on', () => {
  const { raw, arrives } = start();
  expect([raw(0n, 10), raw(0n, 20)]).toEqual([10, 20]);
  arrives(1000, 10);
  expect(raw(0n, 1100)).toBe('missing');
});

describe('another clock', () => {
  test('is watched first; then what is later than the earliest is late by that much', () => {
    const { arrives } = start();
    for (let t = 0; t < 900; t += 100) expect(arrives(t, 20, YEARS_MS)).toBe('unsettled');
    for (let t = 1000; t < 30_000; t += 100) expect(arrives(t, 20, YEARS_MS)).toBeCloseTo(t + 20, 1);
    expect(arrives(30_000, 620, YEARS_MS)).toBeCloseTo(30_020, 1);
    // A topic that is later than others of the same clock, too.
    expect(arrives(30_700, 250, YEARS_MS, '/points')).toBeCloseTo(30_720, 1);
    // After a while, a lasting delay of all is taken for the path's own.
    for (let t = 31_000; t < 60_000; t += 100) arrives(t, 620, YEARS_MS);
    expect(arrives(60_000, 620, YEARS_MS)).toBeCloseTo(60_620, 1);
  });

  test('that begins anew is old until it is known again', () => {
    const { arrives } = start();
    for (let t = 0; t < 5000; t += 100) arrives(t, 20, YEARS_MS);
    const restarted = arrives(5000, 20, YEARS_MS - 500_000);
    expect(restarted).toBeCloseTo(5020 - 500_000, 1);
    for (let t = 5100; t < 40_000; t += 100) arrives(t, 20, YEARS_MS - 500_000);
    expect(arrives(40_000, 20, YEARS_MS - 500_000)).toBeCloseTo(40_020, 1);
  });

  test('of a single message among ours is not believed', () => {
    const { arrives } = start();
    for (let t = 0; t < 5000; t += 100) arrives(t, 20);
    expect(arrives(5000, 20, YEARS_MS)).toBe('unsettled');
    expect(arrives(5100, 20)).toBeCloseTo(5100, 1);
  });
});
