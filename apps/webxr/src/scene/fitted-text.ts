/** Fits a line of the wrist panel into its width, so that long texts stay readable. */

/** Rows that are drawn one below the other, with letters of this height, pixels. */
export interface FittedText {
  readonly rows: readonly string[];
  readonly size: number;
}

/** Of a text that takes two rows, and the least of one that takes one, pixels. */
const SMALL = 19;
const LEAST = 23;

/**
 * One row if the text fits with letters that are not much smaller, else two rows of small letters, else as much of them
 * as there is room for.
 *
 * @param size of the letters in one row, pixels
 * @param measure width of a text with letters of a size, pixels
 */
export function fitText(
  text: string,
  size: number,
  width: number,
  measure: (text: string, size: number) => number,
): FittedText {
  const one = Math.min(size, Math.floor((size * width) / measure(text, size)));
  if (one >= LEAST && measure(text, one) <= width) return { rows: [text], size: one };
  const fits = (row: string) => measure(row, SMALL) <= width;
  const words = text.split(' ');
  let first = words.length;
  while (first > 1 && !fits(words.slice(0, first).join(' '))) first--;
  const rows = [words.slice(0, first).join(' '), words.slice(first).join(' ')];
  return { rows: rows.filter((row) => row !== '').map((row) => shortened(row, fits)), size: SMALL };
}

/** As much of a row as there is room for, with an ellipsis where something is left out. */
export function shortened(row: string, fits: (row: string) => boolean): string {
  if (fits(row)) return row;
  let length = row.length - 1;
  while (length > 0 && !fits(`${row.slice(0, length).trimEnd()}…`)) length--;
  return `${row.slice(0, length).trimEnd()}…`;
}
