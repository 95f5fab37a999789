import { expect, test } from 'vitest';
import { Reconnect } from './reconnect.ts';

/** When a SYN leaves: at the start of an attempt, and again 1 and 3 s later if the attempt still waits (RFC 6298). */
function synTimes(untilMs: number, random: () => number): number[] {
  const reconnect = new Reconnect(random);
  const times: number[] = [];
  for (let nowMs = 0; nowMs < untilMs; ) {
    const { timeoutMs } = reconnect;
    for (const afterMs of [0, 1000, 3000]) if (afterMs < timeoutMs) times.push(nowMs + afterMs);
    nowMs += timeoutMs + reconnect.nextMs();
  }
  return times;
}

test('during two minutes without a network, a SYN leaves at least every 3 s, mostly every 2.5 s', () => {
  for (const random of [() => 0, () => 0.5, () => 0.999]) {
    const times = synTimes(120_000, random);
    const gaps = times.slice(1).map((time, i) => time - (times[i] as number));
    expect(Math.max(...gaps)).toBeLessThanOrEqual(3000);
    expect(gaps.filter((gap) => gap <= 2500).length / gaps.length).toBeGreaterThan(0.8);
    expect(times.length).toBeLessThan(120);
  }
});

test('gives slow networks more time now and then', () => {
  const reconnect = new Reconnect(() => 0.5);
  const timeouts = [0, 1, 2, 3, 4].map(() => {
    const { timeoutMs } = reconnect;
    reconnect.nextMs();
    return timeoutMs;
  });
  expect(timeouts).toEqual([2500, 2500, 2500, 5000, 2500]);
});

test('waits at most 1 s for the first minutes, up to 12.5 s after that, and briefly again after success', () => {
  const reconnect = new Reconnect(() => 0.999);
  const waits = Array.from({ length: 80 }, () => reconnect.nextMs());
  expect(Math.max(...waits.slice(0, 60))).toBeLessThan(1000);
  expect(waits.at(-1)).toBeCloseTo(12_495);
  reconnect.reset();
  expect(reconnect.nextMs()).toBeLessThan(320);
});
