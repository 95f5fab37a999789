/**
 * Reduces what is drawn if the machine cannot keep up: fewer points of a whole cloud, and on a flat screen fewer
 * pixels. A late picture is worse than a coarse one. No clock here.
 */

/** How much is drawn. */
export interface DrawingStep {
  /** Fraction of the screen's own resolution. */
  scale: number;
  /** Only one of this many points of a coded cloud is drawn. */
  every: number;
}

export const DRAWING_STEPS: readonly DrawingStep[] = [
  { scale: 1, every: 1 },
  { scale: 0.75, every: 2 },
  { scale: 0.5, every: 4 },
  { scale: 0.5, every: 8 },
  { scale: 0.5, every: 16 },
  { scale: 0.35, every: 16 },
];
// `pnpm bench first-drive` measures what these numbers give: docs/decisions/2026-11-28-first-drive.md.

/**
 * Where a computer that draws in software begins: coarse at once, and finer if it can, instead of late at
 * first. `pnpm bench first-drive`: whole resolution and all points 6 % of the time obeyed, half and 1 of 16
 * points 95 %.
 */
const SOFTWARE_STEP = DRAWING_STEPS.length - 1;

/**
 * Fewer display frames a second for {@link SLOW_FOR_MS} ask for less, as many for {@link FAST_FOR_MS} allow
 * more.
 */
const SLOW_FPS = 24;
const FAST_FPS = 50;
/**
 * A timer that is so late keeps the operator's hand from being read, and one that is less late than that does
 * not, ms. A hand counts as read for 100 ms (grips.ts).
 */
const HITCH_MS = 80;
const SMOOTH_MS = 55;
const SLOW_FOR_MS = 1500;
const FAST_FOR_MS = 6000;
/** Wait before the next step up after one that was too much. */
const PATIENCE_MS = 60_000;

/**
 * Chooses how much is drawn, from the display frame rate that the machine reaches, and from how late the page's timers are:
 * where the processor draws, every point takes its time from the hand, the network and the robot's pictures.
 */
export class DrawingGovernor {
  #step: number;
  #slowSinceMs: number | null = null;
  #fastSinceMs: number | null = null;
  #steppedUpMs = Number.NEGATIVE_INFINITY;
  #noUpBeforeMs = Number.NEGATIVE_INFINITY;

  /** @param software whether the computer has no graphics processor */
  constructor(software = false) {
    this.#step = software ? SOFTWARE_STEP : 0;
  }

  /** How much is to be drawn now. */
  get step(): DrawingStep {
    return DRAWING_STEPS[this.#step] as DrawingStep;
  }

  /**
   * Call it about once a second.
   *
   * @param displayFps display frames per second that it could draw, over the last second
   * @param nowMs `performance.now()`
   * @param worstGapMs the longest time between two ticks of a frequent timer within the last second
   * @returns whether {@link step} has changed
   */
  update(displayFps: number, nowMs: number, worstGapMs = 0): boolean {
    const isLate = displayFps < SLOW_FPS || worstGapMs > HITCH_MS;
    const isSmooth = displayFps > FAST_FPS && worstGapMs < SMOOTH_MS;
    this.#slowSinceMs = isLate ? (this.#slowSinceMs ?? nowMs) : null;
    this.#fastSinceMs = isSmooth ? (this.#fastSinceMs ?? nowMs) : null;
    const isSlow = this.#slowSinceMs !== null && nowMs - this.#slowSinceMs >= SLOW_FOR_MS;
    const isFast = this.#fastSinceMs !== null && nowMs - this.#fastSinceMs >= FAST_FOR_MS;
    if (isSlow && this.#step < DRAWING_STEPS.length - 1) {
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

  /** Discards measurements: the page was hidden, or VR was active. */
  pause(): void {
    this.#slowSinceMs = null;
    this.#fastSinceMs = null;
  }
}
