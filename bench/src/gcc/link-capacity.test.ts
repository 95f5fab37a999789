import { expect, test } from 'vitest';
import { LinkCapacity } from './link-capacity.ts';

test('no rate is far from an unknown capacity', () => {
  const capacity = new LinkCapacity();
  expect(capacity.isKnown).toBe(false);
  expect([capacity.isFarAbove(1), capacity.isFarBelow(1e9)]).toEqual([false, false]);
});

test('the first sample sets it; later ones move it by a twentieth', () => {
  const capacity = new LinkCapacity();
  capacity.add(10e6);
  expect(capacity.estimate).toBe(10e6);
  capacity.add(12e6);
  expect(capacity.estimate).toBeCloseTo(10.1e6);
  capacity.reset();
  expect(capacity.isKnown).toBe(false);
});

test('uses three standard deviations: the minimum for few samples, more if samples differ', () => {
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
