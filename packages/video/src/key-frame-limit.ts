/** When requests for key frames are passed on: at once, but not more often than each `intervalMs`. */
export class KeyFrameLimit {
  readonly #intervalMs: number;
  #lastMs = Number.NEGATIVE_INFINITY;
  #waiting = false;

  constructor(intervalMs: number) {
    this.#intervalMs = intervalMs;
  }

  /**
   * Call for each request.
   *
   * @returns ms until it is to be passed on, 0 for at once; `null` if an earlier one that waits serves it, too
   */
  request(nowMs: number): number | null {
    if (this.#waiting) return null;
    const waitMs = this.#lastMs + this.#intervalMs - nowMs;
    if (waitMs <= 0) {
      this.#lastMs = nowMs;
      return 0;
    }
    this.#waiting = true;
    return waitMs;
  }

  /** Call when a wait has ended and the request is passed on. */
  passed(nowMs: number): void {
    this.#waiting = false;
    this.#lastMs = nowMs;
  }
}
