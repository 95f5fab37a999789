import { writeFileSync } from 'node:fs';

/** Rows have at most this many columns. */
const MOST_COLUMNS = 4;

/**
 * A table of numbers for measurements, written as CSV when the robot stops. Fixed memory, no allocation per row; the
 * oldest rows are overwritten.
 */
export class ColumnLog {
  readonly #path: string;
  readonly #columns: readonly string[];
  readonly #rows: Float64Array;
  readonly #capacity: number;
  #count = 0;

  /**
   * @param path where {@link write} puts the log
   * @param columns up to four names
   * @param capacity number of rows that are kept
   */
  constructor(path: string, columns: readonly string[], capacity: number) {
    if (columns.length > MOST_COLUMNS) throw new RangeError(`${columns.length} columns`);
    this.#path = path;
    this.#columns = columns;
    this.#capacity = capacity;
    this.#rows = new Float64Array(capacity * columns.length);
  }

  write(): void {
    const width = this.#columns.length;
    const lines = [this.#columns.join(',')];
    for (let i = Math.max(0, this.#count - this.#capacity); i < this.#count; i++) {
      const at = (i % this.#capacity) * width;
      lines.push(Array.from(this.#rows.subarray(at, at + width), cellOf).join(','));
    }
    writeFileSync(this.#path, `${lines.join('\n')}\n`);
  }

  protected addRow(a: number, b = 0, c = 0, d = 0): void {
    const width = this.#columns.length;
    const at = (this.#count % this.#capacity) * width;
    this.#rows[at] = a;
    if (width > 1) this.#rows[at + 1] = b;
    if (width > 2) this.#rows[at + 2] = c;
    if (width > 3) this.#rows[at + 3] = d;
    this.#count++;
  }
}

function cellOf(value: number): string {
  return Number.isInteger(value) ? String(value) : value.toFixed(4);
}
