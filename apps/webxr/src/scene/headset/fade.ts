/** Lets something appear and disappear without a jump. Pure: time is an argument, ms. */

/** From gone to wholly there, ms. Chosen: soft to the eye, and still there within a quarter of a second with a frame's delay. */
const FADE_MS = 200;

export class Fade {
  /** Whether it is to be seen. */
  shown = false;
  #share = 0;

  /** It is gone at once. */
  clear(): void {
    this.shown = false;
    this.#share = 0;
  }

  /** @param elapsedMs since the last call @returns 0 (gone) … 1 */
  update(elapsedMs: number): number {
    const step = elapsedMs / FADE_MS;
    this.#share = this.shown ? Math.min(1, this.#share + step) : Math.max(0, this.#share - step);
    return this.#share;
  }
}
