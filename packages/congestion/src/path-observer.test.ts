import type { PacketResult } from '@farpoint/rtp';
import { expect, test } from 'vitest';
import { PathObserver } from './path-observer.ts';

/** Packets 1 ms apart, each delayed by `delayMs` of its sending time. */
function message(
  from: number,
  count: number,
  delayMs: (sentMs: number) => number,
): { results: PacketResult[]; nowMs: number } {
  const results = Array.from({ length: count }, (_, i) => ({
    transportSequence: (from + i) & 0xffff,
    bytes: 1250,
    sentMs: from + i,
    arrivalUs: (from + i + delayMs(from + i)) * 1000,
  }));
  return { results, nowMs: from + count - 1 + Math.min(delayMs(from + count - 1), 200) + 20 };
}

function feed(path: PathObserver, from: number, to: number, delayMs: (sentMs: number) => number): void {
  for (let at = from; at < to; at += 50) {
    const { results, nowMs } = message(at, 50, delayMs);
    path.onFeedback(results, nowMs);
  }
}

test('queueing delay is the excess over the least delay; the rate is what arrives', () => {
  const path = new PathObserver();
  feed(path, 0, 500, () => 20);
  expect(path.observation.queueMs).toBeCloseTo(0);
  expect(path.observation.ackedBitsPerSecond).toBeCloseTo(10e6, -5);
  // From here on, the link takes 2 ms per packet.
  feed(path, 500, 600, (t) => 20 + (t - 500));
  expect(path.observation.queueEndMs).toBeGreaterThan(90);
  expect(path.observation.ackedBitsPerSecond).toBeCloseTo(5e6, -5);
  expect(path.rateWhileQueued(5, 25)).toBeCloseTo(5e6, -5);
});

test('a missing message does not look like a slower path', () => {
  const path = new PathObserver();
  feed(path, 0, 500, () => 20);
  feed(path, 600, 650, () => 20);
  expect(path.observation.ackedBitsPerSecond).toBeCloseTo(10e6, -5);
});

test('a clock that jumps is no queue', () => {
  const path = new PathObserver();
  feed(path, 0, 500, () => 20);
  const { results } = message(500, 50, () => 520);
  expect(path.onFeedback(results, 590)).toBe(false);
  expect(path.clockJumps).toBe(1);
  const next = message(550, 50, () => 520).results;
  expect(path.onFeedback(next, 640)).toBe(true);
  expect(path.observation.queueMs).toBeLessThan(15);
});

test('delay that goes up and down is noise, delay that grows is not', () => {
  const noisy = new PathObserver();
  feed(noisy, 0, 3000, (t) => 20 + (Math.floor(t / 50) % 2) * 10);
  const growing = new PathObserver();
  feed(growing, 0, 3000, (t) => 20 + t / 20);
  expect(noisy.noiseMs).toBeGreaterThan(5);
  expect(growing.noiseMs).toBeLessThan(1);
});

test('a path that stalled for a moment keeps its rate', () => {
  const path = new PathObserver();
  feed(path, 0, 500, () => 20);
  // From 510 on nothing moves; at 530 all of it arrives, and what follows waits as long.
  feed(path, 500, 550, (t) => (t < 510 ? 20 : 40));
  expect(path.observation.queueEndMs).toBeCloseTo(20);
  expect(path.observation.ackedBitsPerSecond).toBeLessThan(9e6);
  expect(path.rateWhileQueued(5, 25)).toBeCloseTo(10e6, -5);
  expect(path.rateWhileQueued(25, 25)).toBeNaN();
  // A queue at the very end of a message gives no rate.
  feed(path, 550, 1000, () => 20);
  feed(path, 1000, 1050, (t) => (t < 1040 ? 20 : 40));
  expect(path.observation.queueEndMs).toBeCloseTo(20);
  expect(path.rateWhileQueued(5, 25)).toBeNaN();
});
