/** Shrinks pictures by an integer factor: each pixel is the mean of a square of pixels. */

/** A picture that is read one row at a time. */
export interface PictureRows {
  width: number;
  height: number;
  /** @param into R, G, B, 255 of each pixel of the row */
  readRow(row: number, into: Uint8Array): void;
}

/** The smallest factor at which no side is longer than `longestSide`. */
export function shrinkFactor(width: number, height: number, longestSide: number): number {
  return Math.max(1, Math.ceil(Math.max(width, height) / longestSide));
}

/** The remainder at the right and at the bottom is cut off. */
export function shrunkSize(width: number, height: number, factor: number): { width: number; height: number } {
  return { width: Math.max(1, Math.floor(width / factor)), height: Math.max(1, Math.floor(height / factor)) };
}

export class ShrinkingFilter {
  #row = new Uint8Array(0);
  #sums = new Uint32Array(0);
  #out = new Uint8Array(0);

  /** @returns pixels that the next call overwrites */
  shrink(rows: PictureRows, factor: number): { width: number; height: number; rgba: Uint8Array } {
    const { width, height } = shrunkSize(rows.width, rows.height, factor);
    const bytes = width * height * 4;
    if (this.#out.length < bytes) this.#out = new Uint8Array(bytes);
    const rgba = this.#out.subarray(0, bytes);
    if (factor === 1) {
      for (let row = 0; row < height; row++)
        rows.readRow(row, rgba.subarray(row * width * 4, (row + 1) * width * 4));
      return { width, height, rgba };
    }
    if (this.#row.length < rows.width * 4) this.#row = new Uint8Array(rows.width * 4);
    if (this.#sums.length < width * 3) this.#sums = new Uint32Array(width * 3);
    const { length } = rgba;
    for (let row = 0, to = 0; to < length; row++) {
      const across = Math.min(factor, rows.width);
      const down = Math.min(factor, rows.height);
      this.#sums.fill(0);
      for (let line = 0; line < down; line++) this.#add(rows, row * factor + line, width, across, factor);
      const count = across * down;
      for (let i = 0; i < width * 3; i += 3, to += 4) {
        rgba[to] = ((this.#sums[i] as number) + (count >> 1)) / count;
        rgba[to + 1] = ((this.#sums[i + 1] as number) + (count >> 1)) / count;
        rgba[to + 2] = ((this.#sums[i + 2] as number) + (count >> 1)) / count;
        rgba[to + 3] = 255;
      }
    }
    return { width, height, rgba };
  }

  #add(rows: PictureRows, row: number, width: number, across: number, factor: number): void {
    const line = this.#row;
    const sums = this.#sums;
    rows.readRow(row, line);
    for (let x = 0, i = 0; x < width; x++, i += 3) {
      let from = x * factor * 4;
      let [red, green, blue] = [0, 0, 0];
      for (let n = 0; n < across; n++, from += 4) {
        red += line[from] as number;
        green += line[from + 1] as number;
        blue += line[from + 2] as number;
      }
      sums[i] = (sums[i] as number) + red;
      sums[i + 1] = (sums[i + 1] as number) + green;
      sums[i + 2] = (sums[i + 2] as number) + blue;
    }
  }
}

/** A picture that is entirely in memory. */
export function rgbaRows(pixels: { width: number; height: number; rgba: Uint8Array }): PictureRows {
  const { width, height, rgba } = pixels;
  return {
    width,
    height,
    readRow: (row, into) => into.set(rgba.subarray(row * width * 4, (row + 1) * width * 4)),
  };
}
