/** One frame that could not be sent whole says nothing; the second within so many makes the next ones smaller … */
const WINDOW_FRAMES = 15;
/** … by this much … */
const CUT = 0.8;
/** … but not without end; and grow again by this much with each that could. */
const LEAST = 0.25;
const GROWTH = 1.04;

/**
 * How much of what the path carries is planned for: all of it, unless frames are not over when the next ones come. That
 * happens where the path has just slowed down, and for longer where this computer is too busy to send in time. Smaller
 * frames that arrive whole show more than large ones whose farthest points are always cut off.
 */
export class FrameFit {
  #share = 1;
  #framesSinceCut = WINDOW_FRAMES;

  get share(): number {
    return this.#share;
  }

  /** A frame was sent to its last packet. */
  onSent(): void {
    this.#framesSinceCut++;
    this.#share = Math.min(this.#share * GROWTH, 1);
  }

  /** A frame, or the rest of one, gave way to a newer one. */
  onCut(): void {
    if (this.#framesSinceCut < WINDOW_FRAMES) this.#share = Math.max(this.#share * CUT, LEAST);
    this.#framesSinceCut = 0;
  }
}
