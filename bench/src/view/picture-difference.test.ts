import { expect, test } from 'vitest';
import { differenceOf, type Picture } from './picture-difference.ts';

const SIZE = 32;

/** A picture of this brightness and depth at each pixel. */
function picture(
  brightness: (x: number, y: number) => number,
  depth: (x: number, y: number) => number,
): Picture {
  const made = { colour: new Uint8Array(SIZE * SIZE * 4), depth: new Float32Array(SIZE * SIZE) };
  for (let y = 0; y < SIZE; y++) {
    for (let x = 0; x < SIZE; x++) {
      made.colour.fill(brightness(x, y), (y * SIZE + x) * 4, (y * SIZE + x) * 4 + 3);
      made.depth[y * SIZE + x] = depth(x, y);
    }
  }
  return made;
}

const stripes = (x: number): number => (x % 4 < 2 ? 60 : 180);
const truth = picture(stripes, () => 2);

test('the same picture differs in nothing', () => {
  expect(differenceOf(truth, truth, SIZE)).toEqual({ holes: 0, ssim: 1, depthErrorM: 0 });
});

test('counts holes only where the true picture has something', () => {
  const half = picture(stripes, (x) => (x < SIZE / 2 ? 0 : 2));
  expect(differenceOf(half, truth, SIZE).holes).toBe(0.5);
  expect(differenceOf(truth, half, SIZE).holes).toBe(0);
});

test('takes the median of the error of depth', () => {
  expect(
    differenceOf(
      picture(stripes, (x) => (x === 0 ? 9 : 2.5)),
      truth,
      SIZE,
    ).depthErrorM,
  ).toBe(0.5);
});

test('other structure is less similar than other brightness', () => {
  const brighter = picture(
    (x) => stripes(x) + 20,
    () => 2,
  );
  const flat = picture(
    () => 120,
    () => 2,
  );
  const similar = differenceOf(brighter, truth, SIZE).ssim;
  expect(similar).toBeGreaterThan(0.9);
  expect(differenceOf(flat, truth, SIZE).ssim).toBeLessThan(0.1);
});
