/** The rows of the sign before the eyes. Pure. */
import { wrapText } from './wrapped-text.ts';

/** A sentence in one look. @typeParam Look of its rows */
interface Said<Look> {
  readonly text: string;
  readonly look: Look;
}

export interface FittedRows<Look> {
  readonly rows: readonly Said<Look>[];
  /** Size of the letters, and from one row to the next, as a share of the usual. */
  readonly share: number;
}

/** By how much letters become smaller in one try. Chosen: too little to be seen, and few tries. */
const SMALLER_SHARE = 0.95;

/**
 * Breaks texts into rows. What has more rows than there is room for has smaller letters: nothing is said by half.
 *
 * @param width of a row, pixels
 * @param most rows with letters of the usual size
 * @param measure width of a text with letters of the usual size, pixels
 */
export function signRows<Look>(
  said: readonly Said<Look>[],
  width: number,
  most: number,
  measure: (text: string, look: Look) => number,
): FittedRows<Look> {
  for (let share = 1; ; share *= SMALLER_SHARE) {
    const rows = said.flatMap(({ text, look }) =>
      wrapText(text, width / share, (words) => measure(words, look)).map((row) => ({ text: row, look })),
    );
    if (rows.length * share <= most) return { rows, share };
  }
}
