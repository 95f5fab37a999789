/** The capture instant of what the page shows now: clouds and videos. Time is an argument. */

/**
 * Without anything new for this long, nothing is being presented, ms. As long as pictures may be old before
 * the page says so (camera-view.ts).
 */
const FRESH_MS = 1000;

export class PresentedInstant {
  #instantMs = Number.NEGATIVE_INFINITY;
  #atMs = Number.NEGATIVE_INFINITY;

  /** @param instantMs robot's clock @param nowMs page's clock */
  show(instantMs: number, nowMs: number): void {
    // Sources that are not in step may be behind others.
    if (instantMs < this.#instantMs && nowMs - this.#atMs < FRESH_MS) return;
    this.#instantMs = instantMs;
    this.#atMs = nowMs;
  }

  /** The newest instant that is shown, robot's clock, ms; `null` if nothing new has been shown for a while. */
  at(nowMs: number): number | null {
    return nowMs - this.#atMs < FRESH_MS ? this.#instantMs : null;
  }

  clear(): void {
    this.#instantMs = Number.NEGATIVE_INFINITY;
    this.#atMs = Number.NEGATIVE_INFINITY;
  }
}
