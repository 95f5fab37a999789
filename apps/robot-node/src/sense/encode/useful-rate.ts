/**
 * Once a frame uses this share of its budget, its format could use more. Chosen: coded frames end up to 6 %
 * below their budget (`CODED_SLACK` in plan.ts).
 */
const SATURATED_SHARE = 0.9;
/**
 * The claim exceeds the measured use by this factor, so that a richer scene shows at once as a used-up
 * budget. Chosen: above 1 / 0.9, or a claim would hold itself down.
 */
const MARGIN = 1.3;
/**
 * How much of the highest use so far is left after each frame. Chosen: half of it is gone after 34 frames, a
 * second; a short look at a wall frees nothing.
 */
const DECAY = 0.98;

export interface FrameUse {
  /** What the frame's packets take on the wire, bits. */
  wireBits: number;
  /** What they might have taken, bits. */
  budgetBits: number;
  /** Whether that is less than a frame like it could use. */
  limited: boolean;
  framesPerSecond: number;
  /** An upper bound for frames like it, bit/s. */
  mostBitsPerSecond: number;
}

/**
 * How much of a path a sensor can use, as its frames show it. A bound from the number of points alone is far too high for
 * simple scenes and slow machines, and would keep other sensors from what the path has left.
 */
export class UsefulRate {
  /** Highest use of late, bit/s. */
  #used = 0;

  /** @returns bit/s on the wire */
  update({ wireBits, budgetBits, limited, framesPerSecond, mostBitsPerSecond }: FrameUse): number {
    const used = wireBits * framesPerSecond;
    this.#used = Math.max(used, this.#used * DECAY);
    if (limited && wireBits >= budgetBits * SATURATED_SHARE) return mostBitsPerSecond;
    return Math.min(this.#used * MARGIN, mostBitsPerSecond);
  }
}
