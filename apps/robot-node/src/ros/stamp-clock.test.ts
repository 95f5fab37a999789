import { expect, test } from 'vitest';
import { StampClock } from './stamp-clock.ts';

/** A clock of this machine at which the monotonic one began at `beganMs` of the day. */
function start(beganMs = 1e12) {
  let nowMs = 0;
  const clock = new StampClock({
    now: () => nowMs,
    wallNs: () => BigInt(Math.round((beganMs + nowMs) * 1e6)),
  });
  return {
    /** What was captured then, by a clock that is ahead of ours, and how long it took to come. */
    arrives(atMs: number, delayMs: number, aheadMs = 0) {
      nowMs = atMs + delayMs;
      return clock.capturedAtMs(BigInt(Math.round((beganMs + atMs + aheadMs) * 1e6)), nowMs);
    },
    raw: (stampNs: bigint, receivedMs: number) => {
      nowMs = receivedMs;
      return clock.capturedAtMs(stampNs, receivedMs);
    },
  };
}

test('stamps of our own clock are taken at their word, also when the delay grows', () => {
  const { arrives } = start();
  for (let t = 0; t < 5000; t += 100) expect(arrives(t, 30)).toBeCloseTo(t, 1);
  expect(arrives(5000, 400)).toBeCloseTo(5000, 1);
  expect(arrives(5100, 900)).toBeCloseTo(5130, 1);
});

test('of another clock, what is later than the earliest is late by that much', () => {
  for (const ahead of [-90_000, 40_000]) {
    const { arrives } = start();
    for (let t = 0; t < 30_000; t += 100) expect(arrives(t, 20, ahead)).toBeCloseTo(t + 20, 1);
    expect(arrives(30_000, 620, ahead)).toBeCloseTo(30_020, 1);
    // After a while, a lasting delay is taken for the path's own.
    for (let t = 31_000; t < 60_000; t += 100) arrives(t, 620, ahead);
    expect(arrives(60_000, 620, ahead)).toBeCloseTo(60_620, 1);
  }
});

test('a message that is not newer is none; after a jump back, the clock begins anew', () => {
  const { arrives } = start();
  expect(arrives(1000, 10)).toBeCloseTo(1000, 1);
  expect(arrives(1000, 50)).toBeNull();
  expect(arrives(900, 200)).toBeNull();
  const simulated = start();
  expect(simulated.arrives(100_000, 10, -90_000)).toBeCloseTo(100_010, 1);
  expect(simulated.arrives(100_100, 10, -99_000)).toBeCloseTo(100_110, 1);
});

test('without stamps, the arrival counts', () => {
  const { raw } = start();
  expect([raw(0n, 10), raw(0n, 20)]).toEqual([10, 20]);
});
