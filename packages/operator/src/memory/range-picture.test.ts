import fc from 'fast-check';
import { expect, test } from 'vitest';
import { RangePicture } from './range-picture.ts';

const unit = fc.tuple(
  fc.float({ min: -1, max: 1, noNaN: true }),
  fc.float({ min: -1, max: 1, noNaN: true }),
  fc.float({ min: -1, max: 1, noNaN: true }),
);

test('finds the least range in the direction in which it was added', () => {
  const picture = new RangePicture();
  fc.assert(
    fc.property(unit, fc.float({ min: 1, max: 9, noNaN: true }), ([x, y, z], range) => {
      fc.pre(Math.hypot(x, y, z) > 0.01);
      picture.clear();
      picture.add(x, y, z, range + 1);
      picture.add(x, y, z, range);
      expect(picture.at(x, y, z)).toBeCloseTo(range, 5);
    }),
  );
});

test('says nothing beside a single ring, and the nearest beside what is dense', () => {
  const picture = new RangePicture();
  for (let angle = -0.5; angle < 0.5; angle += 0.002) picture.add(Math.sin(angle), 0.1, Math.cos(angle), 5);
  expect(picture.nearestAround(0, 0.1, 1)).toBe(0);
  for (let y = 0; y < 0.2; y += 0.002) {
    for (let angle = -0.1; angle < 0.1; angle += 0.002)
      picture.add(Math.sin(angle), y, Math.cos(angle), angle < 0 ? 4 : 5);
  }
  expect(picture.nearestAround(0.05, 0.1, 1)).toBe(5);
  expect(picture.nearestAround(0.002, 0.1, 1)).toBe(4);
  expect(picture.nearestAround(0, 0.1, -1)).toBe(0);
});
