/**
 * The latency barcode: the capture time of a picture as black and white squares in its top-left corner. It survives
 * video codecs, so whoever shows the picture can tell its age. Layout: docs/protocol.md, "Latency barcode".
 */
import { CRC16_START, crc16OfWord } from './crc16.ts';

/** Side of a square, pixels. */
export const BARCODE_SQUARE = 8;
/** Squares in a row, and rows. */
export const BARCODE_COLUMNS = 18;
export const BARCODE_ROWS = 7;
/** Size of the barcode, pixels. */
export const BARCODE_WIDTH = BARCODE_COLUMNS * BARCODE_SQUARE;
export const BARCODE_HEIGHT = BARCODE_ROWS * BARCODE_SQUARE;

const BLACK = 16;
const WHITE = 235;

/** Whether a square belongs to the frame around the data. */
export function isBarcodeFrame(column: number, row: number): boolean {
  return column === 0 || row === 0 || column === BARCODE_COLUMNS - 1 || row === BARCODE_ROWS - 1;
}

/** Whether a square of the frame is white. */
export function isBarcodeFrameWhite(column: number, row: number): boolean {
  return (column + row) % 2 === 0;
}

/** The checksum that follows the time. */
export function barcodeChecksum(hi: number, lo: number): number {
  return crc16OfWord(crc16OfWord(CRC16_START, hi), lo);
}

/**
 * Draws a barcode over the top-left corner of a picture.
 *
 * @param luma 8 bits a pixel: a grey picture, or the Y plane of another
 * @param stride bytes from one row of the picture to the next
 * @param hi upper 32 bits of the capture time, ns
 * @param lo lower 32 bits
 * @throws {RangeError} if the picture has no room for {@link BARCODE_WIDTH} × {@link BARCODE_HEIGHT} pixels
 */
export function drawBarcode(luma: Uint8Array, stride: number, hi: number, lo: number): void {
  if (!(stride >= BARCODE_WIDTH && luma.length >= (BARCODE_HEIGHT - 1) * stride + BARCODE_WIDTH))
    throw new RangeError(`no room for a barcode in ${luma.length} bytes, ${stride} a row`);
  const checksum = barcodeChecksum(hi, lo);
  for (let row = 0; row < BARCODE_ROWS; row++) {
    const bits = dataBits(row, hi, lo, checksum);
    const top = row * BARCODE_SQUARE * stride;
    for (let column = 0; column < BARCODE_COLUMNS; column++) {
      const isWhite = isBarcodeFrame(column, row)
        ? isBarcodeFrameWhite(column, row)
        : ((bits >> (BARCODE_COLUMNS - 2 - column)) & 1) === 1;
      const left = top + column * BARCODE_SQUARE;
      luma.fill(isWhite ? WHITE : BLACK, left, left + BARCODE_SQUARE);
    }
    for (let line = 1; line < BARCODE_SQUARE; line++)
      luma.copyWithin(top + line * stride, top, top + BARCODE_WIDTH);
  }
}

/** The 16 bits of a row, leftmost first. */
function dataBits(row: number, hi: number, lo: number, checksum: number): number {
  switch (row) {
    case 1:
      return hi >>> 16;
    case 2:
      return hi & 0xffff;
    case 3:
      return lo >>> 16;
    case 4:
      return lo & 0xffff;
    default:
      return checksum;
  }
}
