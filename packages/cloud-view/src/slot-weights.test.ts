import { expect, test } from 'vitest';
import { SlotWeights } from './slot-weights.ts';

const has = () => 0;
const hasNot = () => null;

test('a picture that is there when its frame begins is shown at once', () => {
  const slots = new SlotWeights();
  slots.begin(3, true);
  slots.update(10, true, (slot) => (slot === 3 ? 1 : null));
  expect([...slots.weights].filter((weight) => weight > 0)).toEqual([1]);
});

test('one that comes later appears gradually', () => {
  const slots = new SlotWeights();
  slots.update(1000, true, hasNot);
  slots.begin(3, false);
  const seen = [1050, 1100, 1150, 1200].map((ms) => {
    slots.update(ms, true, has);
    return slots.weights[3];
  });
  expect(seen[0]).toBeCloseTo(1 / 3, 5);
  expect(seen[1]).toBeCloseTo(2 / 3, 5);
  expect(seen.slice(2)).toEqual([1, 1]);
});

test('pictures that are switched off disappear gradually, and those that are gone at once', () => {
  const slots = new SlotWeights();
  slots.update(1000, true, has);
  slots.begin(0, true);
  slots.update(1075, false, has);
  expect(slots.weights[0]).toBeCloseTo(0.5, 5);
  slots.update(1300, false, has);
  expect(slots.weights[0]).toBe(0);
  slots.begin(0, true);
  slots.update(1301, true, hasNot);
  expect(slots.weights[0]).toBe(0);
});
