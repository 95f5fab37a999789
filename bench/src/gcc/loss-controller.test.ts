import { describe, expect, test } from 'vitest';
import { LossController } from './loss-controller.ts';

const FAR = 100e6;

function after(lostOf1000: number): number {
  const loss = new LossController(10e6, 1e5);
  loss.onReport(1000, lostOf1000, FAR);
  expect(loss.fraction).toBe(lostOf1000 / 1000);
  return loss.estimate / 1e6;
}

describe('by the loss since the last report', () => {
  test('less than 2 %: raises the rate by 5 %', () => {
    expect(after(0)).toBeCloseTo(10.5);
    expect(after(19)).toBeCloseTo(10.5);
  });

  test('2 to 10 %: keeps the rate', () => {
    expect(after(20)).toBe(10);
    expect(after(100)).toBe(10);
  });

  test('more than 10 %: lowers the rate by half the loss', () => {
    expect(after(101)).toBeCloseTo(10 * (1 - 0.0505));
    expect(after(1000)).toBeCloseTo(5);
  });
});

test('waits for the next report if few packets were sent and some lost', () => {
  const loss = new LossController(10e6, 1e5);
  loss.onReport(10, 10, FAR);
  expect(loss.estimate).toBe(10e6);
  loss.onReport(10, 0, FAR);
  expect(loss.estimate).toBe(7.5e6);
  loss.onReport(1, 0, FAR);
  expect(loss.estimate).toBe(7.5e6 * 1.05);
});

test('never exceeds the delay-based rate or falls below the minimum', () => {
  const loss = new LossController(10e6, 1e5);
  loss.onReport(100, 0, 4e6);
  expect(loss.estimate).toBe(4e6);
  for (let i = 0; i < 100; i++) loss.onReport(100, 100, 4e6);
  expect(loss.estimate).toBe(1e5);
});

test('is raised and never lowered by a probe', () => {
  const loss = new LossController(10e6, 1e5);
  loss.raise(20e6);
  expect(loss.estimate).toBe(20e6);
  loss.raise(5e6);
  expect(loss.estimate).toBe(20e6);
});
