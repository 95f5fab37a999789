/** One line that says how far a long benchmark is, where somebody reads it: a terminal, not a file. */

/** Between two lines, ms. */
const EVERY_MS = 1000;

export class Progress {
  readonly #total: number;
  readonly #what: string;
  #shownMs = 0;

  /** @param what is counted, in the plural */
  constructor(total: number, what: string) {
    this.#total = total;
    this.#what = what;
  }

  /** @param done of the total; writes at most once a second */
  update(done: number): void {
    if (!process.stderr.isTTY || performance.now() - this.#shownMs < EVERY_MS) return;
    this.#shownMs = performance.now();
    process.stderr.write(`\r${done} of ${this.#total} ${this.#what}\u001B[K`);
  }

  /** Takes the line away. */
  end(): void {
    if (this.#shownMs > 0) process.stderr.write('\r\u001B[K');
  }
}
