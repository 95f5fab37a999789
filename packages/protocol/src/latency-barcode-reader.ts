import type { BarcodeTime } from './barcode-time.ts';
import {
  BARCODE_COLUMNS,
  BARCODE_HEIGHT,
  BARCODE_ROWS,
  BARCODE_SQUARE,
  BARCODE_WIDTH,
  barcodeChecksum,
  isBarcodeFrame,
  isBarcodeFrameWhite,
} from './latency-barcode.ts';

/** Why no time is read from a picture. */
export type BarcodeFault =
  | 'too-small' // no room for a barcode
  | 'no-barcode' // the frame around the data is not there, or hardly visible
  | 'unclear' // a square of the data is neither black nor white
  | 'bad-checksum';

export type BarcodeReading = { time: BarcodeTime; fault: null } | { time: null; fault: BarcodeFault };

/** Of a square, only the pixels in the middle count: its edges are blurred by scaling and by codecs. */
const MARGIN = 2;
const SAMPLES = (BARCODE_SQUARE - 2 * MARGIN) ** 2;
/** Between the means of the frame's black and white squares, of 255. */
const MIN_CONTRAST = 32;
/** How far from the threshold a square must be, as a share of the contrast. */
const CLEAR = 1 / 4;

/**
 * Reads the barcode in the top-left corner of a picture, at the size at which it was drawn. Brightness and contrast do
 * not matter.
 *
 * @param pixels 1 byte a pixel: luma; 3 or 4: red, green and blue first
 * @param width of the picture, pixels
 * @param height of the picture, pixels
 * @param stride bytes from one row of the picture to the next
 * @returns the time, or why there is none: never the time of a picture without an undamaged barcode, but for one in
 *   65,536 among those with an undamaged frame around random squares
 */
export function readBarcode(
  pixels: Uint8Array | Uint8ClampedArray,
  width: number,
  height: number,
  stride: number,
  bytesPerPixel: 1 | 3 | 4,
): BarcodeReading {
  const rowBytes = BARCODE_WIDTH * bytesPerPixel;
  const hasRoom =
    width >= BARCODE_WIDTH &&
    height >= BARCODE_HEIGHT &&
    stride >= rowBytes &&
    pixels.length >= (BARCODE_HEIGHT - 1) * stride + rowBytes;
  if (!hasRoom) return refused('too-small');
  const means = squareMeans(pixels, stride, bytesPerPixel);
  const { threshold, clear } = measureFrame(means);
  if (!(clear >= MIN_CONTRAST * CLEAR)) return refused('no-barcode');
  // Time and checksum, 16 bits a row.
  const rows = [0, 0, 0, 0, 0];
  let isClear = true;
  for (let row = 0; row < BARCODE_ROWS; row++) {
    for (let column = 0; column < BARCODE_COLUMNS; column++) {
      const above = (means[row * BARCODE_COLUMNS + column] as number) - threshold;
      if (isBarcodeFrame(column, row)) {
        if ((isBarcodeFrameWhite(column, row) ? above : -above) < clear) return refused('no-barcode');
      } else {
        isClear &&= Math.abs(above) >= clear;
        rows[row - 1] = ((rows[row - 1] as number) << 1) | (above > 0 ? 1 : 0);
      }
    }
  }
  if (!isClear) return refused('unclear');
  const [first, second, third, fourth, checksum] = rows as [number, number, number, number, number];
  const time = { hi: ((first << 16) | second) >>> 0, lo: ((third << 16) | fourth) >>> 0 };
  if (barcodeChecksum(time.hi, time.lo) !== checksum) return refused('bad-checksum');
  return { time, fault: null };
}

function refused(fault: BarcodeFault): BarcodeReading {
  return { time: null, fault };
}

/** The mean luma of the middle of each square, row by row. */
function squareMeans(
  pixels: Uint8Array | Uint8ClampedArray,
  stride: number,
  bytesPerPixel: number,
): Float64Array {
  const means = new Float64Array(BARCODE_ROWS * BARCODE_COLUMNS);
  for (let i = 0; i < means.length; i++) {
    const column = i % BARCODE_COLUMNS;
    const top = ((i - column) / BARCODE_COLUMNS) * BARCODE_SQUARE;
    const left = column * BARCODE_SQUARE;
    let sum = 0;
    for (let y = top + MARGIN; y < top + BARCODE_SQUARE - MARGIN; y++) {
      for (let x = left + MARGIN; x < left + BARCODE_SQUARE - MARGIN; x++) {
        const at = y * stride + x * bytesPerPixel;
        sum += bytesPerPixel === 1 ? (pixels[at] as number) : lumaAt(pixels, at);
      }
    }
    means[i] = sum / SAMPLES;
  }
  return means;
}

/** ITU-R BT.709. */
function lumaAt(pixels: Uint8Array | Uint8ClampedArray, at: number): number {
  const red = pixels[at] as number;
  const green = pixels[at + 1] as number;
  const blue = pixels[at + 2] as number;
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

/** What the frame says about black and white: the threshold between them, and how far from it a square must be. */
function measureFrame(means: Float64Array): { threshold: number; clear: number } {
  let black = 0;
  let white = 0;
  let blacks = 0;
  for (let row = 0; row < BARCODE_ROWS; row++) {
    for (let column = 0; column < BARCODE_COLUMNS; column++) {
      if (!isBarcodeFrame(column, row)) continue;
      const mean = means[row * BARCODE_COLUMNS + column] as number;
      if (isBarcodeFrameWhite(column, row)) white += mean;
      else {
        black += mean;
        blacks++;
      }
    }
  }
  // Around the barcode, black and white take turns: there are as many of each.
  black /= blacks;
  white /= blacks;
  return { threshold: (black + white) / 2, clear: (white - black) * CLEAR };
}
