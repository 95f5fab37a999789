import { expect, test } from 'vitest';
import { changedTiles } from './tile-change.ts';

const SIDES = { width: 40, height: 20, noisePerZ2: 0.0015 };
const images = (z: number, colour = 0x404040) => ({
  depth: new Float32Array(800).fill(z),
  colour: new Uint32Array(800).fill(colour),
});

test('tells tiles that have changed, also those that the picture’s edge cuts', () => {
  const now = images(2);
  expect(changedTiles(SIDES, images(2), now)).toEqual(new Uint8Array(6));
  // Noise: within 4 standard deviations of a difference, 0.0015 m · z² · √2 each.
  now.depth.fill(2.03);
  expect(changedTiles(SIDES, images(2), now)).toEqual(new Uint8Array(6));
  now.depth.fill(2.05, 0, 16);
  expect([...changedTiles(SIDES, images(2), now)]).toEqual([1, 0, 0, 0, 0, 0]);
  now.depth.fill(0);
  expect([...changedTiles(SIDES, images(2), now)]).toEqual([1, 1, 1, 1, 1, 1]);
});

test('tells colours', () => {
  const now = images(2);
  now.colour.fill(0x40404c, 799 - 8);
  expect(changedTiles(SIDES, images(2), now)).toEqual(new Uint8Array(6));
  now.colour.fill(0x404d40, 799 - 8);
  expect([...changedTiles(SIDES, images(2), now)]).toEqual([0, 0, 0, 0, 0, 1]);
});

test('a few pixels that come and go are no change', () => {
  const now = images(2);
  now.depth.fill(0, 0, 16);
  expect(changedTiles(SIDES, images(2), now)).toEqual(new Uint8Array(6));
});
