import { expect, test } from 'vitest';
import { RateMeter } from './rate-meter.ts';

test('measures over its window and forgets what is older', () => {
  const meter = new RateMeter(1000);
  expect(meter.perSecond).toBe(0);
  for (let now = 0; now <= 2000; now += 250) meter.update(now * 2, now);
  expect(meter.perSecond).toBe(2000);
  for (let now = 2250; now <= 3500; now += 250) meter.update(4000, now);
  expect(meter.perSecond).toBe(0);
});

test('measures over a partial window from two samples on', () => {
  const meter = new RateMeter();
  meter.update(100, 0);
  expect(meter.perSecond).toBe(0);
  meter.update(150, 500);
  expect(meter.perSecond).toBe(100);
  meter.reset();
  expect(meter.perSecond).toBe(0);
});

test('never falls below zero', () => {
  const meter = new RateMeter();
  meter.update(10, 0);
  meter.update(0, 100);
  expect(meter.perSecond).toBe(0);
});
