/**
 * A single frame that could not be sent whole changes nothing. A second one within this many frames, half of
 * a second at 30 a second, makes the next ones smaller … All four are chosen; frame-fit.test.ts holds the
 * others.
 */
const WINDOW_FRAMES = 15;
/** … by this factor … */
const CUT = 0.8;
/**
 * … but not below this share. Each frame sent whole makes them larger by the factor that follows: from the
 * least to all in 36 frames.
 */
const LEAST = 0.25;
const GROWTH = 1.04;

/**
 * The share of the path's rate to plan for. It is all of the rate, unless frames are still being sent when the next
 * ones arrive. That happens when the path has just slowed down, and for longer when this computer is too busy to send
 * in time. Smaller frames that arrive whole show more than large ones whose farthest points are always cut off.
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

  /** A frame, or its rest, was dropped for a newer one. */
  onCut(): void {
    if (this.#framesSinceCut < WINDOW_FRAMES) this.#share = Math.max(this.#share * CUT, LEAST);
    this.#framesSinceCut = 0;
  }
}
