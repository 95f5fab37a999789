import { expect, test } from 'vitest';
import { clipSize } from './clip-size.ts';

test.each([
  [
    { width: 3840, height: 2160 },
    { width: 1280, height: 720 },
  ],
  [
    { width: 361, height: 801 },
    { width: 360, height: 800 },
  ],
  [
    { width: 1000, height: 4000 },
    { width: 320, height: 1280 },
  ],
  [
    { width: 0, height: 0 },
    { width: 2, height: 2 },
  ],
])('%o gives pictures of %o', (canvas, size) => {
  expect(clipSize(canvas)).toEqual(size);
});
