import { describe, expect, test } from 'vitest';
import { AimdRate } from './aimd-rate.ts';

const RTT_MS = 50;
const STEP_MS = 50;

/** Updates the rate for `ms` with `incoming` bit/s. @returns the time afterwards */
function run(rate: AimdRate, fromMs: number, ms: number, incoming: () => number): number {
  let now = fromMs;
  for (; now < fromMs + ms; now += STEP_MS) rate.update('normal', incoming(), RTT_MS, now);
  return now;
}

/** A controller that has seen the path full at 10 Mbit/s. */
function converged(): { rate: AimdRate; now: number } {
  const rate = new AimdRate(10e6, 1e5, 100e6);
  rate.update('over', 10e6, RTT_MS, 0);
  return { rate, now: 1000 };
}

describe('increase', () => {
  test('by 8 % a second while the path was never full', () => {
    const rate = new AimdRate(1e6, 1e5, 100e6);
    run(rate, 0, 10_000 + STEP_MS, () => rate.estimate);
    expect(rate.estimate / 1e6).toBeCloseTo(1.08 ** 10, 2);
  });

  test('by at most 1,000 bit/s at a time at very low rates', () => {
    const rate = new AimdRate(10_000, 5000, 100e6);
    run(rate, 0, 2 * STEP_MS, () => 1e6);
    expect(rate.estimate).toBe(12_000);
  });

  test('by half a packet per response time near convergence', () => {
    const { rate, now } = converged();
    const before = rate.estimate;
    rate.update('normal', before, RTT_MS, now);
    run(rate, now, 10_000 + STEP_MS, () => rate.estimate);
    // 8.5 Mbit/s is 30 frames of 30 packets of 1,181 bytes; the response time is 150 ms.
    expect(rate.estimate - before).toBeCloseTo((10 * 0.5 * 9444) / 0.15, -3);
  });

  test('by 8 % again once more arrives than the path’s known capacity', () => {
    const { rate, now } = converged();
    rate.update('normal', 10e6, RTT_MS, now);
    run(rate, now, 2000, () => 10.5e6);
    expect(rate.estimate).toBeGreaterThan(8.5e6 * 1.15);
  });

  test('to no more than 1.5 times the incoming rate', () => {
    const rate = new AimdRate(1e6, 1e5, 100e6);
    run(rate, 0, 30_000, () => 1e6);
    expect(rate.estimate).toBe(1.51e6);
    run(rate, 30_000, 1000, () => 0.1e6);
    expect(rate.estimate).toBe(1.51e6);
  });

  test('to no more than the maximum', () => {
    const rate = new AimdRate(1e6, 1e5, 2e6);
    run(rate, 0, 30_000, () => rate.estimate);
    expect(rate.estimate).toBe(2e6);
  });
});

describe('decrease', () => {
  test('to 85 % of the incoming rate, then hold', () => {
    const rate = new AimdRate(10e6, 1e5, 100e6);
    rate.update('over', 8e6, RTT_MS, 0);
    expect(rate.estimate).toBe(0.85 * 8e6);
    expect(rate.state).toBe('hold');
  });

  test('holds while the queue drains, then increases', () => {
    const { rate } = converged();
    for (let now = 50; now < 1000; now += STEP_MS) rate.update('under', 10e6, RTT_MS, now);
    expect(rate.estimate).toBe(8.5e6);
    rate.update('normal', 8.5e6, RTT_MS, 1000);
    expect(rate.estimate).toBe(8.5e6);
    rate.update('normal', 8.5e6, RTT_MS, 1050);
    expect(rate.estimate).toBeGreaterThan(8.5e6);
  });

  test('follows another one only after a response time', () => {
    const rate = new AimdRate(10e6, 1e5, 100e6);
    rate.update('over', 9e6, RTT_MS, 0);
    rate.update('over', 8e6, RTT_MS, 149);
    expect(rate.estimate).toBe(0.85 * 9e6);
    rate.update('over', 8e6, RTT_MS, 150);
    expect(rate.estimate).toBe(0.85 * 8e6);
  });

  test('but immediately if hardly anything arrives', () => {
    const rate = new AimdRate(10e6, 1e5, 100e6);
    rate.update('over', 9e6, RTT_MS, 0);
    rate.update('over', 1e6, RTT_MS, 50);
    expect(rate.estimate).toBe(0.85e6);
  });

  test('never raises the rate: while the queue drains, more arrives than is sent', () => {
    const { rate, now } = converged();
    rate.update('over', 12e6, RTT_MS, now);
    expect(rate.estimate).toBeLessThanOrEqual(8.5e6);
  });

  test('by half if the incoming rate is unknown, never below the minimum', () => {
    const rate = new AimdRate(10e6, 3e6, 100e6);
    rate.update('over', Number.NaN, RTT_MS, 0);
    expect(rate.estimate).toBe(5e6);
    rate.update('over', Number.NaN, RTT_MS, 1000);
    expect(rate.estimate).toBe(3e6);
  });
});
