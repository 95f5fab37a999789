/**
 * Holds clouds until the videos that were captured with them are shown. Videos take longer: they are encoded, put
 * together and decoded. Time is an argument.
 */
import { type Distribution, SampleWindow } from '../latency/sample-window.ts';
import { SAME_INSTANT_US } from './capture-instant.ts';

// `pnpm bench cameras` measures how far apart clouds and pictures are with these numbers (docs/cameras.md).

/** For one who only watches, ms: nothing is lost by it; docs/janus.md has what it gives. */
const WATCHER_HOLD_MS = 200;
/** For one who drives, ms beyond the time from one picture to the next … */
const DRIVER_MARGIN_MS = 10;
/** … and at most: the points are what obstacles are seen by. */
const MOST_DRIVER_HOLD_MS = 60;
/** Videos that have not gone on for so long have stopped, ms. */
const VIDEO_SILENT_MS = 200;
/** From one picture to the next, and from one cloud to the next, at first, ms … */
const FIRST_INTERVAL_MS = 33;
/** … and at most. */
const MOST_INTERVAL_MS = 100;
/** What was left out makes a step longer, but not the interval: it grows by this share of the difference. */
const GROWTH = 1 / 8;
/** Share of the newest value in the mean of what clouds had to wait. */
const MEAN_SHARE = 1 / 32;
/** Holding ends only when it is so much too short, as a factor: a change shifts the delay of what is seen. */
const END_FACTOR = 1.3;
const MOST_AWAITED = 64;
const SAMPLES_KEPT = 512;

interface Cloud {
  readonly captureMs: number;
  readonly arrivedMs: number;
}

interface Waiting extends Cloud {
  pass(): void;
}

/** How long a cloud may wait, ms, where videos come at this interval, ms. */
export type HoldLimit = (intervalMs: number) => number;

/** Clouds pass at once. */
export const noHold: HoldLimit = () => 0;
/** For one who only watches: up to 200 ms, because nothing is lost by it. */
export const watcherHold: HoldLimit = () => WATCHER_HOLD_MS;
/** For one who drives: an interval of the videos and 10 ms, at most 60 ms, because the points show obstacles. */
export const driverHold: HoldLimit = (intervalMs) =>
  Math.min(intervalMs + DRIVER_MARGIN_MS, MOST_DRIVER_HOLD_MS);

/** How clouds and videos fit together, of the newest clouds that were passed while videos were shown. */
export interface CloudHoldStats {
  /** How much later a cloud was captured than the video's frame it is seen with, ms; `null`: no cloud yet. */
  readonly aheadMs: Distribution | null;
  /** How long a cloud waited, ms; `null`: no cloud yet. */
  readonly heldMs: Distribution | null;
}

/** Holds clouds back until the videos of their instant are shown, but never longer than its limit. */
export class CloudHold {
  readonly #limit: HoldLimit;
  readonly #waiting: Waiting[] = [];
  /** Clouds whose videos are still to come, whether they wait for them or not. */
  readonly #awaited: Cloud[] = [];
  readonly #ahead = new SampleWindow(SAMPLES_KEPT);
  readonly #held = new SampleWindow(SAMPLES_KEPT);
  #videoMs: number | null = null;
  #videoIntervalMs = FIRST_INTERVAL_MS;
  #cloudIntervalMs = FIRST_INTERVAL_MS;
  /** Captured last of the clouds that have arrived. */
  #newestMs = Number.NEGATIVE_INFINITY;
  /** When the videos last went on, ms. */
  #wentOnMs = Number.NEGATIVE_INFINITY;
  /** The mean of how long clouds would have to wait, ms. */
  #neededMs = 0;
  #isWorthIt = true;
  /** Whether clouds wait for the picture of their very instant, e.g. because it paints them, and not for one near it. */
  exact = false;
  /** When the newest cloud that was passed was captured, ms on the robot's clock; `null` before the first. */
  passedMs: number | null = null;

  /** @param limit {@link noHold}, {@link watcherHold}, {@link driverHold}, or one's own */
  constructor(limit: HoldLimit) {
    this.#limit = limit;
  }

  /**
   * Takes a cloud that has arrived.
   *
   * @param captureMs when it was captured: ms on the robot's clock
   * @param nowMs when it arrived: ms on the clock of {@link advance}
   * @param pass called once, now or at a later {@link advance}, in the order of arrival
   */
  add(captureMs: number, nowMs: number, pass: () => void): void {
    this.#waiting.push({ captureMs, arrivedMs: nowMs, pass });
    if (captureMs > this.#newestMs) {
      const stepMs = captureMs - this.#newestMs;
      if (Number.isFinite(stepMs)) this.#cloudIntervalMs = intervalAfter(this.#cloudIntervalMs, stepMs);
      this.#newestMs = captureMs;
      this.#awaited.push({ captureMs, arrivedMs: nowMs });
    }
    if (this.#awaited.length > MOST_AWAITED) this.#awaited.shift();
    this.#passDue(nowMs);
  }

  /**
   * Passes what has waited long enough. Call it for each display frame.
   *
   * @param videoMs the newest capture instant of what is shown of the videos, robot's clock; `null` for none
   */
  advance(videoMs: number | null, nowMs: number): void {
    if (videoMs !== this.#videoMs) {
      this.#wentOnMs = nowMs;
      const stepMs = (videoMs ?? 0) - (this.#videoMs ?? Number.POSITIVE_INFINITY);
      if (stepMs > 0) this.#videoIntervalMs = intervalAfter(this.#videoIntervalMs, stepMs);
      this.#videoMs = videoMs;
      if (videoMs !== null) this.#judge(videoMs, nowMs);
    }
    this.#passDue(nowMs);
  }

  /** Passes all at once. */
  clear(): void {
    for (const { pass } of this.#waiting.splice(0)) pass();
    this.#awaited.length = 0;
    this.#videoMs = null;
    this.#videoIntervalMs = FIRST_INTERVAL_MS;
    this.#cloudIntervalMs = FIRST_INTERVAL_MS;
    this.#newestMs = Number.NEGATIVE_INFINITY;
    this.#wentOnMs = Number.NEGATIVE_INFINITY;
    this.#neededMs = 0;
    this.#isWorthIt = true;
    this.passedMs = null;
  }

  /** Of what was passed while videos were shown. */
  get stats(): CloudHoldStats {
    return { aheadMs: this.#ahead.distribution(), heldMs: this.#held.distribution() };
  }

  /** Restarts both distributions. */
  resetDistributions(): void {
    this.#ahead.clear();
    this.#held.clear();
  }

  get #mostHeldMs(): number {
    return this.#limit(this.#videoIntervalMs);
  }

  /** What was captured so long after a picture at most belongs to it: usually half an interval of the slower source. */
  get #togetherMs(): number {
    if (this.exact) return SAME_INSTANT_US / 1000;
    return Math.max(this.#videoIntervalMs, this.#cloudIntervalMs) / 2;
  }

  /** Videos that come later than a cloud may wait are not waited for in vain. */
  #judge(videoMs: number, nowMs: number): void {
    for (let next = this.#awaited[0]; next !== undefined; next = this.#awaited[0]) {
      if (next.captureMs - videoMs > this.#togetherMs) break;
      this.#awaited.shift();
      this.#neededMs += (nowMs - next.arrivedMs - this.#neededMs) * MEAN_SHARE;
    }
    this.#isWorthIt = this.#neededMs <= this.#mostHeldMs * (this.#isWorthIt ? END_FACTOR : 1);
  }

  #passDue(nowMs: number): void {
    // Nothing to be in step with, or not any more.
    const videoMs = nowMs - this.#wentOnMs > VIDEO_SILENT_MS ? null : this.#videoMs;
    const mostHeldMs = this.#isWorthIt ? this.#mostHeldMs : 0;
    for (let next = this.#waiting[0]; next !== undefined; next = this.#waiting[0]) {
      const aheadMs = videoMs === null ? 0 : next.captureMs - videoMs;
      const heldMs = nowMs - next.arrivedMs;
      if (aheadMs > this.#togetherMs && heldMs < mostHeldMs) return;
      this.#waiting.shift();
      if (videoMs !== null) {
        this.#ahead.add(aheadMs);
        this.#held.add(heldMs);
      }
      this.passedMs = next.captureMs;
      next.pass();
    }
  }
}

function intervalAfter(intervalMs: number, stepMs: number): number {
  const longer = intervalMs + (Math.min(stepMs, MOST_INTERVAL_MS) - intervalMs) * GROWTH;
  return Math.min(stepMs, longer);
}
