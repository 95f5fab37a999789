import { expect, test } from 'vitest';
import { DecoderBacklog } from './decoder-backlog.ts';

const stale = (...waits: number[]) => {
  const backlog = new DecoderBacklog();
  return waits.map((waitedMs) => backlog.isStale(waitedMs));
};

test('decodes packets that waited up to a tenth of a second', () => {
  expect(stale(0, 50, 100, 99, 0)).toEqual([false, false, false, false, false]);
});

test('once behind, drops all packets until they are fresh again', () => {
  expect(stale(0, 100, 101, 60, 21, 20, 60)).toEqual([false, false, true, true, true, false, false]);
});

test.each([-5000, 700])('a clock offset of %d ms makes no difference', (apartMs) => {
  const waits = [0, 100, 101, 60, 20].map((waitedMs) => waitedMs + apartMs);
  expect(stale(...waits)).toEqual([false, false, true, true, false]);
});

test('decodes packets that waited for the decoder to start', () => {
  expect(stale(600, 590, 300, 10)).toEqual([false, false, false, false]);
});

test('says how long a packet waited beyond the shortest wait, which no packet can do without', () => {
  const backlog = new DecoderBacklog();
  const waits = [-5000, -4930, -4990, Number.NaN, -5100, -5000].map((waitedMs) => {
    backlog.isStale(waitedMs);
    return backlog.waitedMs;
  });
  expect(waits).toEqual([0, 70, 10, 0, 0, 100]);
});

test('drops nothing if the browser provides no arrival times', () => {
  expect(stale(Number.NaN, Number.NaN)).toEqual([false, false]);
});

/** A decoder that takes `costMs` per packet, and hardly any time for a dropped one; packets come every `everyMs`. */
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

test('a decoder half as fast as packets arrive shows half of them, and no old ones', () => {
  const { decoded, longestMs } = run(0.4, 0.2, 100_000);
  expect(longestMs).toBeLessThanOrEqual(100);
  expect(decoded / 100_000).toBeGreaterThan(0.45);
});

test('a decoder that keeps up drops none', () => {
  expect(run(0.19, 0.2, 100_000).decoded).toBe(100_000);
});
