import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { PictureMatch } from './picture-match.ts';

const MS = 1000;

describe('a picture paints the frame of its capture instant', () => {
  test('whichever of the two comes first', () => {
    const match = new PictureMatch(4);
    const early = match.place(100 * MS);
    match.expect(100 * MS);
    match.expect(200 * MS);
    const late = match.place(200 * MS);
    expect(early).not.toBeNull();
    expect(late).not.toBeNull();
    expect(match.layerOf(100 * MS)).toBe(early);
    expect(match.layerOf(200 * MS)).toBe(late);
    expect(match.layerOf(133 * MS)).toBeNull();
  });

  test('whose stamp was rounded to 1/90 ms', () => {
    const match = new PictureMatch(4);
    match.expect(100_005);
    const layer = match.place(Math.round((Math.floor(100.005 * 90) / 90) * MS));
    expect(match.layerOf(100_005)).toBe(layer);
    expect(match.layerOf(101_005)).toBeNull();
  });

  test('also where stamps wrap', () => {
    const match = new PictureMatch(4);
    const before = 2 ** 32 - 20 * MS;
    match.expect(before);
    match.place(before);
    match.expect(13 * MS);
    expect(match.place(13 * MS)).not.toBeNull();
    expect(match.layerOf(before)).not.toBeNull();
    // Between the two.
    expect(match.place(2 ** 32 - 3 * MS)).toBeNull();
  });
});

test('a picture between two frames of the cloud is not kept', () => {
  const match = new PictureMatch(4);
  match.expect(100 * MS);
  match.expect(200 * MS);
  expect(match.place(133 * MS)).toBeNull();
  expect(match.place(233 * MS)).not.toBeNull();
});

test('what will paint nothing gives way first, then the oldest', () => {
  const match = new PictureMatch(3);
  const has = (...instants: number[]) => instants.map((ms) => match.layerOf(ms * MS) !== null);
  match.expect(100 * MS);
  for (const ms of [100, 133, 167]) match.place(ms * MS);
  match.expect(167 * MS);
  match.place(200 * MS);
  expect(has(100, 133, 167, 200)).toEqual([true, false, true, true]);
  match.place(233 * MS);
  expect(has(100, 167, 200, 233)).toEqual([false, true, true, true]);
});

test('pictures that come before their frames wait for them, while others come', () => {
  const match = new PictureMatch(8);
  for (let ms = 100; ms < 2000; ms += 100) {
    match.expect(ms * MS);
    for (const later of [0, 33, 67]) match.place((ms + 100 + later) * MS);
    expect(match.layerOf(ms * MS) !== null).toBe(ms > 100);
  }
});

test('pictures are forgotten without the frames, or with them', () => {
  const match = new PictureMatch(2);
  match.expect(100 * MS);
  match.place(100 * MS);
  match.forgetPictures();
  expect(match.layerOf(100 * MS)).toBeNull();
  expect(match.place(50 * MS)).toBeNull();
  match.forget();
  expect(match.place(50 * MS)).not.toBeNull();
});

test('no layer ever has two pictures, and none paints a frame of another instant', () => {
  const step = fc.record({ instantMs: fc.nat(40), isPicture: fc.boolean() });
  fc.assert(
    fc.property(fc.array(step, { maxLength: 200 }), fc.integer({ min: 1, max: 6 }), (steps, layers) => {
      const match = new PictureMatch(layers);
      const inLayer = new Map<number, number>();
      for (const { instantMs, isPicture } of steps) {
        const instant = instantMs * MS;
        if (!isPicture) match.expect(instant);
        else {
          const layer = match.place(instant);
          if (layer !== null) inLayer.set(layer, instant);
        }
      }
      expect(inLayer.size).toBeLessThanOrEqual(layers);
      for (let ms = 0; ms <= 40; ms++) {
        const layer = match.layerOf(ms * MS);
        if (layer !== null) expect(inLayer.get(layer)).toBe(ms * MS);
      }
    }),
    { seed: 1, numRuns: 300 },
  );
});
