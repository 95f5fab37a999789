import { expect, test } from 'vitest';
import { DecoderBacklog } from './decoder-backlog.ts';

const stale = (...waits: number[]) => {
  const backlog = new DecoderBacklog();
  return waits.map((waitedMs) => backlog.isStale(waitedMs));
};

test('what waited up to a tenth of a second is decoded', () => {
  expect(stale(0, 50, 100, 99, 0)).toEqual([false, false, false, false, false]);
});

test('behind, all is left out until what comes is new', () => {
  expect(stale(0, 100, 101, 60, 21, 20, 60)).toEqual([false, false, true, true, true, false, false]);
});

test.each([-5000, 700])('clocks that are %d ms apart make no difference', (apartMs) => {
  const waits = [0, 100, 101, 60, 20].map((waitedMs) => waitedMs + apartMs);
  expect(stale(...waits)).toEqual([false, false, true, true, false]);
});

test('what has waited for the decoder to begin is decoded', () => {
  expect(stale(600, 590, 300, 10)).toEqual([false, false, false, false]);
});

test('where the browser does not tell, nothing is left out', () => {
  expect(stale(Number.NaN, Number.NaN)).toEqual([false, false]);
});

/** A decoder that takes `costMs` a packet and next to nothing for one that it leaves out; they come every `everyMs`. */
function run(costMs: number, everyMs: number, packets: number): { decoded: number; longestMs: number } {
  const backlog = new DecoderBacklog();
  let [now, decoded, longestMs] = [0, 0, 0];
  for (let i = 0; i < packets; i++) {
    now = Math.max(now, i * everyMs);
    const waitedMs = now - i * everyMs;
    if (backlog.isStale(waitedMs)) {
      now += costMs / 50;
      continue;
    }
    decoded++;
    longestMs = Math.max(longestMs, waitedMs);
    now += costMs;
  }
  return { decoded, longestMs };
}

test('a decoder half as fast as packets come shows none that is old, and half of them', () => {
  const { decoded, longestMs } = run(0.4, 0.2, 100_000);
  expect(longestMs).toBeLessThanOrEqual(100);
  expect(decoded / 100_000).toBeGreaterThan(0.45);
});

test('a decoder that keeps up leaves none out', () => {
  expect(run(0.19, 0.2, 100_000).decoded).toBe(100_000);
});
