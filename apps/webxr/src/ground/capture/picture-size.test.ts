import { expect, test } from 'vitest';
import { contained, pictureSize } from './picture-size.ts';

test.each([
  [3840, 2160, 1280, 720],
  [361, 801, 360, 800],
  [1000, 4000, 320, 1280],
  [0, 0, 2, 2],
])('a view of %i × %i gives a picture of %i × %i', (width, height, pictureWidth, pictureHeight) => {
  expect(pictureSize({ width, height }, 1280)).toEqual({ width: pictureWidth, height: pictureHeight });
});

test('what has other proportions is in the middle, whole', () => {
  const box = { left: 10, top: 20, width: 200, height: 100 };
  expect(contained(box, { width: 50, height: 50 })).toEqual({ left: 60, top: 20, width: 100, height: 100 });
  expect(contained(box, { width: 400, height: 100 })).toEqual({ left: 10, top: 45, width: 200, height: 50 });
  expect(contained(box, { width: 0, height: 0 })).toMatchObject({ width: 0, height: 0 });
});
