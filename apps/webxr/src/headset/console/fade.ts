/** Lets something appear and disappear without a jump. Pure: time is an argument, ms. */
const FADE_MS = 250;

export class Fade {
  /** Whether it is to be seen. */
  shown = false;
  #share = 0;

  /** 0 (gone) … 1. */
  get share(): number {
    return this.#share;
  }

  update(elapsedMs: number): number {
    const step = elapsedMs / FADE_MS;
    this.#share = this.shown ? Math.min(1, this.#share + step) : Math.max(0, this.#share - step);
    return this.#share;
  }
}
