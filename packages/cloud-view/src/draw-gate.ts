/**
 * Decides when a slow machine draws on a flat screen. A GPU that needs most of a display interval for one picture
 * should draw the robot's frames when they are whole, because drawing a fragment delays the rest. A fast GPU always
 * draws. No clock here.
 */

/**
 * Pictures that take less than this are drawn at every display frame, ms. Half of a display interval at 60 a
 * second.
 */
const CHEAP_MS = 8;
/**
 * Longest wait for a frame to become whole, ms. Chosen: one and a half intervals at 30 a second, so that the
 * next frame's points are there; draw-gate.test.ts holds it.
 */
const MAX_HOLD_MS = 50;
/** Weight of the latest cost in the running mean. */
const SMOOTHING = 0.2;

/** Decides whether a flat screen is drawn at a display frame, from the time that a picture takes the GPU. */
export class DrawGate {
  #costMs = 0;
  #lastDrawMs = Number.NEGATIVE_INFINITY;
  #lastEnded: number | null = null;

  /**
   * Asks before each display frame.
   *
   * @param endedFrame the robot's newest frame that has ended; `null` if there is none
   * @param nowMs `performance.now()`
   * @returns whether to draw now
   */
  mayDraw(endedFrame: number | null, nowMs: number): boolean {
    return (
      this.#costMs < CHEAP_MS || endedFrame !== this.#lastEnded || nowMs - this.#lastDrawMs >= MAX_HOLD_MS
    );
  }

  /**
   * Drawing of a picture has started.
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
