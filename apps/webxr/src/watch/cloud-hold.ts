/**
 * Holds clouds until the videos that were captured with them are shown. Videos take longer: they are encoded, put
 * together and decoded. Who drives gets points at once; who watches loses nothing by a tenth of a second, and sees clouds
 * and cameras in step. Time is an argument.
 */
import { type Distribution, SampleWindow } from '@farpoint/operator';

/** A cloud waits no longer than this, ms: its buffers are few, and a camera may have stopped. */
const MOST_HELD_MS = 200;
/** What was captured at most half an interval of the videos after them belongs to them; here at first, ms … */
const FIRST_TOGETHER_MS = 17;
/** … and at most. */
const MOST_TOGETHER_MS = 50;
const SAMPLES_KEPT = 512;

interface Waiting {
  readonly captureMs: number;
  readonly arrivedMs: number;
  pass(): void;
}

export class CloudHold {
  readonly #waiting: Waiting[] = [];
  readonly #ahead = new SampleWindow(SAMPLES_KEPT);
  readonly #held = new SampleWindow(SAMPLES_KEPT);
  #shownMs: number | null = null;
  #togetherMs = FIRST_TOGETHER_MS;
  /** When the videos last went on, ms. */
  #shownAtMs = Number.NEGATIVE_INFINITY;

  /**
   * @param captureMs on the robot's clock
   * @param pass called once, now or at one of the next ticks, in the order of arrival
   */
  add(captureMs: number, nowMs: number, pass: () => void): void {
    this.#waiting.push({ captureMs, arrivedMs: nowMs, pass });
    this.#passDue(nowMs);
  }

  /** @param shownMs the newest capture instant of what is shown of the videos, robot's clock; `null` for none */
  tick(shownMs: number | null, nowMs: number): void {
    if (shownMs !== this.#shownMs) {
      this.#shownAtMs = nowMs;
      const stepMs = (shownMs ?? 0) - (this.#shownMs ?? Number.POSITIVE_INFINITY);
      if (stepMs > 0) this.#togetherMs = Math.min(stepMs / 2, MOST_TOGETHER_MS);
    }
    this.#shownMs = shownMs;
    this.#passDue(nowMs);
  }

  /** Passes all at once. */
  clear(): void {
    for (const { pass } of this.#waiting.splice(0)) pass();
    this.#shownMs = null;
    this.#togetherMs = FIRST_TOGETHER_MS;
    this.#shownAtMs = Number.NEGATIVE_INFINITY;
  }

  /** Of what was passed while videos were shown. */
  get stats(): { aheadMs: Distribution | null; heldMs: Distribution | null } {
    return { aheadMs: this.#ahead.distribution(), heldMs: this.#held.distribution() };
  }

  resetDistributions(): void {
    this.#ahead.clear();
    this.#held.clear();
  }

  #passDue(nowMs: number): void {
    // Nothing to be in step with, or not any more.
    const shownMs = nowMs - this.#shownAtMs > MOST_HELD_MS ? null : this.#shownMs;
    for (let next = this.#waiting[0]; next !== undefined; next = this.#waiting[0]) {
      const aheadMs = shownMs === null ? 0 : next.captureMs - shownMs;
      const heldMs = nowMs - next.arrivedMs;
      if (aheadMs > this.#togetherMs && heldMs < MOST_HELD_MS) return;
      this.#waiting.shift();
      if (shownMs !== null) {
        this.#ahead.add(aheadMs);
        this.#held.add(heldMs);
      }
      next.pass();
    }
  }
}
