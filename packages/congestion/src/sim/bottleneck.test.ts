import { expect, test } from 'vitest';
import { Bottleneck, capacityBits } from './bottleneck.ts';
import { seededRandom } from './random.ts';

const link = (queueBytes: number, ...capacity: [number, number][]) =>
  new Bottleneck(
    { capacity: capacity.map(([fromMs, bitsPerSecond]) => ({ fromMs, bitsPerSecond })), queueBytes },
    seededRandom(1),
  );

test('packets leave one after the other at the link’s rate', () => {
  const wire = link(1e6, [0, 8e6]);
  expect(wire.enter(1000, 0)).toBeCloseTo(1);
  expect(wire.enter(1000, 0)).toBeCloseTo(2);
  expect(wire.enter(1000, 10)).toBeCloseTo(11);
});

test('a packet goes on at the new rate when the capacity changes under it', () => {
  expect(link(1e6, [0, 8e6], [1, 4e6]).enter(2000, 0)).toBeCloseTo(3);
  expect(link(1e6, [0, 0], [500, 8e6]).enter(1000, 0)).toBeCloseTo(501);
  expect(link(1e6, [0, 0]).enter(1000, 0)).toBe(Number.POSITIVE_INFINITY);
});

test('what finds the queue full is dropped, until something has left', () => {
  const wire = link(2000, [0, 8e6]);
  expect([wire.enter(1000, 0), wire.enter(1000, 0), wire.enter(1000, 0)]).toEqual([1, 2, -1]);
  expect(wire.overflows).toBe(1);
  expect(wire.enter(1000, 1)).toBeCloseTo(3);
});

test('capacity between two times', () => {
  const steps = [
    { fromMs: 0, bitsPerSecond: 1000 },
    { fromMs: 1000, bitsPerSecond: 3000 },
  ];
  expect(capacityBits(steps, 500, 2000)).toBeCloseTo(3500);
});
