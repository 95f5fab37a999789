/**
 * When a slow machine draws on a flat screen. A GPU that needs most of a display interval for one picture is better spent
 * on whole frames of the robot than on every fragment of them: drawing a fragment delays the rest. A fast one draws
 * always. No clock here.
 */

/** A picture that costs less than this is drawn at every display frame, ms. */
const CHEAP_MS = 8;
/** A frame that does not become whole is not waited for longer, ms. */
const MAX_HOLD_MS = 50;
/** Weight of the latest cost in the running mean. */
const SMOOTHING = 0.2;

/** Decides whether a flat screen is drawn at a display frame, from what a picture costs the GPU. */
export class DrawGate {
  #costMs = 0;
  #lastDrawMs = Number.NEGATIVE_INFINITY;
  #lastEnded: number | null = null;

  /**
   * Asks before each display frame.
   *
   * @param endedFrame the newest frame of the robot of which no more is waited for; `null` where there is none
   * @param nowMs `performance.now()`
   * @returns whether to draw now
   */
  mayDraw(endedFrame: number | null, nowMs: number): boolean {
    return (
      this.#costMs < CHEAP_MS || endedFrame !== this.#lastEnded || nowMs - this.#lastDrawMs >= MAX_HOLD_MS
    );
  }

  /**
   * A picture was begun.
   *
   * @param endedFrame as in {@link mayDraw}
   * @param nowMs `performance.now()`
   */
  onDraw(endedFrame: number | null, nowMs: number): void {
    this.#lastEnded = endedFrame;
    this.#lastDrawMs = nowMs;
  }

  /** The GPU took this long for a picture, ms. */
  onCost(costMs: number): void {
    this.#costMs += (costMs - this.#costMs) * SMOOTHING;
  }
}
