import { expect, test } from 'vitest';
import type { BarcodeTime } from './barcode-time.ts';
import { BARCODE_HEIGHT, BARCODE_WIDTH, drawBarcode } from './latency-barcode.ts';
import { readBarcode } from './latency-barcode-reader.ts';
import { fillRectangle, generator } from './testing/pictures.ts';

type Next = (bound: number) => number;

const WIDTH = BARCODE_WIDTH;
const HEIGHT = BARCODE_HEIGHT;
const NOISE = Uint8Array.from(
  { length: 4096 + WIDTH * HEIGHT },
  (_, i) => (Math.imul(i, 0x9e3779b1) >>> 9) & 0xff,
);

const level = (next: Next) => (next(2) === 0 ? 16 : 235) + next(21) - 10;

/** Squares, rectangles or stripes, which may lie where a barcode's squares are. */
function drawTiles(luma: Uint8Array, next: Next, valueAt: (column: number, row: number) => number): void {
  const [w, h] = next(2) === 0 ? [8, 8] : [4 + next(20), 4 + next(HEIGHT)];
  const [left, above] = next(2) === 0 ? [0, 0] : [next(w), next(h)];
  for (let row = 0; row * h - above < HEIGHT; row++) {
    const top = Math.max(0, row * h - above) * WIDTH;
    for (let column = 0; column * w - left < WIDTH; column++) {
      const x = column * w - left;
      luma.fill(valueAt(column, row), top + Math.max(0, x), top + Math.min(WIDTH, x + w));
    }
    const bottom = Math.min(HEIGHT, (row + 1) * h - above) * WIDTH;
    for (let at = top + WIDTH; at < bottom; at += WIDTH) luma.copyWithin(at, top, top + WIDTH);
  }
}

/** How many of the pictures are tried, unless all of them are asked for. */
const SHARE = process.env.FARPOINT_LONG_TESTS ? 1 : 1 / 4;

/** Each draws a picture, and returns the time that a reader may find in it. */
const kinds: [string, number, (luma: Uint8Array, next: Next) => BarcodeTime | null][] = [
  [
    'random tiles',
    25_000,
    (luma, next) => {
      drawTiles(luma, next, () => level(next));
      return null;
    },
  ],
  [
    'chessboards and stripes with random errors',
    25_000,
    (luma, next) => {
      const [a, b] = [level(next), level(next)];
      drawTiles(luma, next, (column, row) => (((column + row) % 2 === 0) !== (next(60) === 0) ? a : b));
      return null;
    },
  ],
  [
    'gradients with noise',
    10_000,
    (luma, next) => {
      const [start, across, down, amount] = [next(256), next(5) - 2, next(9) - 4, next(100) / 255];
      const noise = NOISE.subarray(next(4096));
      for (let y = 0, i = 0; y < HEIGHT; y++) {
        for (let x = 0; x < WIDTH; x++, i++)
          luma[i] = start + x * across + y * down + (noise[i] as number) * amount;
      }
      return null;
    },
  ],
  [
    'rectangles',
    20_000,
    (luma, next) => {
      luma.fill(next(256));
      for (let i = 0; i < 30; i++)
        fillRectangle(luma, WIDTH, [next(WIDTH), next(HEIGHT), next(40), next(30)], next(256));
      return null;
    },
  ],
  [
    'a barcode in another place',
    10_000,
    (luma, next) => {
      const time = { hi: next(2 ** 32), lo: next(2 ** 32) };
      drawBarcode(luma, WIDTH, time.hi, time.lo);
      luma.copyWithin(next(9) * WIDTH + next(17), 0);
      return time;
    },
  ],
  [
    'a barcode of which one square of the frame is wrong',
    10_000,
    (luma, next) => {
      drawBarcode(luma, WIDTH, next(2 ** 32), next(2 ** 32));
      const [x, y] = next(2) === 0 ? [next(18) * 8, next(2) * 48] : [next(2) * 136, next(7) * 8];
      fillRectangle(luma, WIDTH, [x, y, 8, 8], luma[y * WIDTH + x] === 16 ? 235 : 16);
      return null;
    },
  ],
];

test.each(kinds)('100,000 pictures, never a wrong time: %s', (_name, count, draw) => {
  const next = generator(count);
  const luma = new Uint8Array(WIDTH * HEIGHT);
  for (let i = 0; i < count * SHARE; i++) {
    const drawn = draw(luma, next);
    const { time } = readBarcode(luma, WIDTH, HEIGHT, WIDTH, 1);
    if (time !== null && (drawn === null || time.hi !== drawn.hi || time.lo !== drawn.lo))
      expect.fail(`picture ${i}: ${JSON.stringify(time)}`);
  }
});
