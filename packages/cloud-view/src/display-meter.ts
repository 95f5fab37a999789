import { sequenceDelta32 } from '@farpoint/protocol';

/** At this rate and above, all that comes is wanted, clouds/s. Chosen: the usual display's rate. */
export const ALL_FRAMES_PER_SECOND = 60;
// `pnpm bench first-drive` measures what these numbers give: docs/decisions/2026-11-28-first-drive.md.

/** Fewer show no world that moves, whatever the computer, clouds/s. */
const LEAST_FRAMES_PER_SECOND = 5;
/** Over this time the clouds that are shown are counted, ms. */
const WINDOW_MS = 1000;
/** Behind: this share of what came was not shown, in so many windows in a row. */
const BEHIND_SHARE = 0.25;
const BEHIND_WINDOWS = 2;
/** In step for so many windows in a row: a little more is tried. */
const STEADY_WINDOWS = 4;
const RAISE = 1.3;
/** Wait before more is tried again after it was too much, windows; doubles each time up to the most. */
const PATIENCE_WINDOWS = 15;
const MOST_PATIENCE_WINDOWS = 120;

/**
 * Measures how many clouds a second this computer shows, so that its operator's robot need not send more: what is decoded
 * and never seen delays what is. No clock here.
 */
export class DisplayMeter {
  #most = ALL_FRAMES_PER_SECOND;
  #beganMs: number | null = null;
  #first = 0;
  #newest: number | null = null;
  #shown = 0;
  #behind = 0;
  #steady = 0;
  #patience = PATIENCE_WINDOWS;
  #waits = 0;
  /** Whether the present rate was tried, and has not yet proven good. */
  #isTrial = false;

  /** Clouds a second that this computer shows; {@link ALL_FRAMES_PER_SECOND}: all that come, as far as it knows. */
  get framesPerSecond(): number {
    return this.#most;
  }

  /**
   * A picture was drawn.
   *
   * @param frame the robot's newest frame in it; `null` for none
   */
  onDrawn(frame: number | null): void {
    if (frame === null || frame === this.#newest) return;
    if (this.#newest === null || sequenceDelta32(frame, this.#newest) < 0) this.#first = frame;
    this.#newest = frame;
    this.#shown++;
  }

  /**
   * Call it a few times a second.
   *
   * @param nowMs `performance.now()`
   * @returns whether {@link framesPerSecond} has changed
   */
  update(nowMs: number): boolean {
    this.#beganMs ??= nowMs;
    const ms = nowMs - this.#beganMs;
    if (ms < WINDOW_MS) return false;
    const came = this.#newest === null ? 0 : sequenceDelta32(this.#newest, this.#first);
    const shown = this.#shown;
    this.#beganMs = nowMs;
    this.#first = this.#newest ?? 0;
    this.#shown = 0;
    // A link that carries little, or a page that was hidden, says nothing about the computer.
    if (shown < 2) return false;
    if (came > shown / (1 - BEHIND_SHARE)) return this.#onBehind((shown * 1000) / ms);
    this.#behind = 0;
    this.#steady++;
    return this.#onSteady();
  }

  /** Discards measurements: the page was hidden, or another robot is chosen. */
  pause(): void {
    this.#beganMs = null;
    this.#newest = null;
    this.#shown = 0;
    this.#behind = 0;
    this.#steady = 0;
  }

  #onBehind(shownPerSecond: number): boolean {
    this.#steady = 0;
    this.#behind++;
    if (this.#behind < BEHIND_WINDOWS) return false;
    this.#behind = 0;
    if (this.#isTrial) this.#patience = Math.min(this.#patience * 2, MOST_PATIENCE_WINDOWS);
    this.#isTrial = false;
    this.#waits = this.#patience;
    return this.#set(Math.min(shownPerSecond, this.#most / RAISE));
  }

  #onSteady(): boolean {
    if (this.#waits > 0) this.#waits--;
    if (this.#steady < STEADY_WINDOWS || this.#most >= ALL_FRAMES_PER_SECOND) return false;
    this.#steady = 0;
    if (this.#isTrial) this.#patience = PATIENCE_WINDOWS;
    if (this.#waits > 0) return false;
    this.#isTrial = true;
    return this.#set(this.#most * RAISE);
  }

  #set(framesPerSecond: number): boolean {
    const most = Math.min(Math.max(framesPerSecond, LEAST_FRAMES_PER_SECOND), ALL_FRAMES_PER_SECOND);
    const rounded = Math.round(most * 10) / 10;
    if (rounded === this.#most) return false;
    this.#most = rounded;
    return true;
  }
}
