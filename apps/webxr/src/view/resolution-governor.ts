/**
 * How finely a flat screen is drawn: fewer pixels where the machine cannot keep up, since a late picture is worse than a
 * coarse one. No clock here.
 */
export const RESOLUTION_STEPS: readonly number[] = [1, 0.75, 0.5];

const SLOW_FPS = 24;
const FAST_FPS = 50;
const SLOW_FOR_MS = 1500;
const FAST_FOR_MS = 6000;
/** After a step up that was too much, the next is tried only after so long. */
const PATIENCE_MS = 60_000;

export class ResolutionGovernor {
  #step = 0;
  #slowSinceMs: number | null = null;
  #fastSinceMs: number | null = null;
  #steppedUpMs = Number.NEGATIVE_INFINITY;
  #noUpBeforeMs = Number.NEGATIVE_INFINITY;

  /** Share of the screen's own resolution. */
  get scale(): number {
    return RESOLUTION_STEPS[this.#step] as number;
  }

  /**
   * @param displayFps display frames a second over the last second
   * @returns whether {@link scale} has changed
   */
  update(displayFps: number, nowMs: number): boolean {
    this.#slowSinceMs = displayFps < SLOW_FPS ? (this.#slowSinceMs ?? nowMs) : null;
    this.#fastSinceMs = displayFps > FAST_FPS ? (this.#fastSinceMs ?? nowMs) : null;
    const isSlow = this.#slowSinceMs !== null && nowMs - this.#slowSinceMs >= SLOW_FOR_MS;
    const isFast = this.#fastSinceMs !== null && nowMs - this.#fastSinceMs >= FAST_FOR_MS;
    if (isSlow && this.#step < RESOLUTION_STEPS.length - 1) {
      this.#step++;
      this.#slowSinceMs = null;
      if (nowMs - this.#steppedUpMs < PATIENCE_MS) this.#noUpBeforeMs = nowMs + PATIENCE_MS;
      return true;
    }
    if (isFast && this.#step > 0 && nowMs >= this.#noUpBeforeMs) {
      this.#step--;
      this.#fastSinceMs = null;
      this.#steppedUpMs = nowMs;
      return true;
    }
    return false;
  }

  /** The page was not looked at, or VR ran: what was measured says nothing. */
  pause(): void {
    this.#slowSinceMs = null;
    this.#fastSinceMs = null;
  }
}
