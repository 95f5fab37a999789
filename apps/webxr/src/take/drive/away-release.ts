/**
 * Nobody has looked for so long: others may drive, ms. Chosen: longer than a look at another tab by mistake.
 */
const AWAY_MS = 2000;

/** Decides when an operator who has left gives up their turn to drive. Time is an argument. */
export class AwayRelease {
  #leftMs: number | null = null;
  #released = false;

  /**
   * @param away whether the headset is off, or the page hidden
   * @param nowMs `performance.now()`
   * @returns true once for each time that the operator has left
   */
  decide(away: boolean, nowMs: number): boolean {
    if (!away) {
      this.#leftMs = null;
      this.#released = false;
      return false;
    }
    this.#leftMs ??= nowMs;
    if (this.#released || nowMs - this.#leftMs < AWAY_MS) return false;
    this.#released = true;
    return true;
  }
}
