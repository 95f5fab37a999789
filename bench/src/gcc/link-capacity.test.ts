import { expect, test } from 'vitest';
import { LinkCapacity } from './link-capacity.ts';

test('nothing is far from a capacity that is unknown', () => {
  const capacity = new LinkCapacity();
  expect(capacity.isKnown).toBe(false);
  expect([capacity.isFarAbove(1), capacity.isFarBelow(1e9)]).toEqual([false, false]);
});

test('the first sample is believed, later ones move it by a twentieth', () => {
  const capacity = new LinkCapacity();
  capacity.add(10e6);
  expect(capacity.estimate).toBe(10e6);
  capacity.add(12e6);
  expect(capacity.estimate).toBeCloseTo(10.1e6);
  capacity.reset();
  expect(capacity.isKnown).toBe(false);
});

test('three standard deviations: those of few samples at first, more where they differ', () => {
  const capacity = new LinkCapacity();
  capacity.add(10e6);
  const margin = 3 * Math.sqrt(0.4 * 10_000) * 1000;
  expect(capacity.isFarBelow(10e6 + 0.99 * margin)).toBe(false);
  expect(capacity.isFarBelow(10e6 + 1.01 * margin)).toBe(true);
  expect(capacity.isFarAbove(10e6 - 0.99 * margin)).toBe(false);
  expect(capacity.isFarAbove(10e6 - 1.01 * margin)).toBe(true);
  for (let i = 0; i < 100; i++) capacity.add(i % 2 === 0 ? 9.7e6 : 10.3e6);
  expect(capacity.isFarBelow(10e6 + 2 * margin)).toBe(false);
});
