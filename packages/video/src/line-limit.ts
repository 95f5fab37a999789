/** Plugins may say the same of each picture: at most so many lines in a time, and then how many were left out. */
export class LineLimit {
  readonly #most: number;
  readonly #perMs: number;
  #beganMs = Number.NEGATIVE_INFINITY;
  #lines = 0;

  constructor(most: number, perMs: number) {
    this.#most = most;
    this.#perMs = perMs;
  }

  /** @returns `null` if the line is left out; else how many were left out before it */
  admit(nowMs: number): number | null {
    let leftOut = 0;
    if (nowMs - this.#beganMs >= this.#perMs) {
      leftOut = Math.max(0, this.#lines - this.#most);
      this.#beganMs = nowMs;
      this.#lines = 0;
    }
    this.#lines++;
    return this.#lines <= this.#most ? leftOut : null;
  }
}
