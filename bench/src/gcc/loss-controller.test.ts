import { describe, expect, test } from 'vitest';
import { LossController } from './loss-controller.ts';

const FAR = 100e6;

function after(lostOf1000: number): number {
  const loss = new LossController(10e6, 1e5);
  loss.onReport(1000, lostOf1000, FAR);
  expect(loss.fraction).toBe(lostOf1000 / 1000);
  return loss.estimate / 1e6;
}

describe('by what was lost since the last report', () => {
  test('less than 2 %: 5 % more', () => {
    expect(after(0)).toBeCloseTo(10.5);
    expect(after(19)).toBeCloseTo(10.5);
  });

  test('2 to 10 %: as it is', () => {
    expect(after(20)).toBe(10);
    expect(after(100)).toBe(10);
  });

  test('more than 10 %: less by half of it', () => {
    expect(after(101)).toBeCloseTo(10 * (1 - 0.0505));
    expect(after(1000)).toBeCloseTo(5);
  });
});

test('few packets wait for the next report where some are lost', () => {
  const loss = new LossController(10e6, 1e5);
  loss.onReport(10, 10, FAR);
  expect(loss.estimate).toBe(10e6);
  loss.onReport(10, 0, FAR);
  expect(loss.estimate).toBe(7.5e6);
  loss.onReport(1, 0, FAR);
  expect(loss.estimate).toBe(7.5e6 * 1.05);
});

test('never above what the delay allows, nor below the least', () => {
  const loss = new LossController(10e6, 1e5);
  loss.onReport(100, 0, 4e6);
  expect(loss.estimate).toBe(4e6);
  for (let i = 0; i < 100; i++) loss.onReport(100, 100, 4e6);
  expect(loss.estimate).toBe(1e5);
});

test('a probe raises it and never lowers it', () => {
  const loss = new LossController(10e6, 1e5);
  loss.raise(20e6);
  expect(loss.estimate).toBe(20e6);
  loss.raise(5e6);
  expect(loss.estimate).toBe(20e6);
});
