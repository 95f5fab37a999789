import { expect, test } from 'vitest';
import { findFloor } from './floor-plane.ts';
import { seeded } from './guarded-drive.ts';

/** Points in the frame of a camera 0.8 m above a floor, which looks down by 0.4 rad and rolls by 0.1. */
function cloud(count: number, heightOf: (x: number, ahead: number, random: () => number) => number) {
  const random = seeded(3);
  const points = new Float32Array(count * 4).fill(Number.NaN);
  const [cp, sp, cr, sr] = [Math.cos(0.4), Math.sin(0.4), Math.cos(0.1), Math.sin(0.1)];
  for (let i = 0; i < count; i++) {
    const [x, ahead] = [random() * 2 - 1, 1 + 2 * random()];
    const down = 0.8 - heightOf(x, ahead, random) + (random() - 0.5) * 0.01;
    const [y, z] = [down * cp - ahead * sp, down * sp + ahead * cp];
    points.set([x * cr - y * sr, x * sr + y * cr, z], i * 4);
  }
  return points;
}

test('finds the floor under furniture', () => {
  const floor = findFloor(cloud(9000, (x, ahead, random) => (x > 0 && ahead > 2 ? random() : 0)));
  expect(floor?.height).toBeCloseTo(0.8, 2);
  const [x, y, z] = floor?.up ?? [0, 0, 0];
  expect(x).toBeCloseTo(Math.cos(0.4) * Math.sin(0.1), 2);
  expect(y).toBeCloseTo(-Math.cos(0.4) * Math.cos(0.1), 2);
  expect(z).toBeCloseTo(-Math.sin(0.4), 2);
});

test('takes no table for the floor, and no heap of things', () => {
  expect(findFloor(cloud(6000, (x, _ahead, random) => (x > 0.2 ? -0.3 - random() : 0)))).toBeNull();
  expect(findFloor(cloud(6000, (_x, _ahead, random) => random()))).toBeNull();
  expect(findFloor(new Float32Array(400).fill(Number.NaN))).toBeNull();
});
