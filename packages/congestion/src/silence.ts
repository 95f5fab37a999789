// What these numbers give together with the others: see adaptive-rate-controller.ts.

/** Feedback counts as missing after this many of its intervals, and this much time, without any. */
const INTERVALS = 4;
const LEAST_MS = 500;
/** The bytes that may be sent per interval, to learn when the path is back. */
const TRICKLE_BYTES = 10_000;
const TRICKLE_MS = 500;

/** Handles the time without feedback: how much may still be sent, and the rate to resume at. */
export class Silence {
  #sinceMs = Number.NaN;
  #trickleMs = 0;
  #windowBytes = 0;

  static begins(inFlightBytes: number, sinceFeedbackMs: number, intervalMs: number, rttMs: number): boolean {
    return inFlightBytes > 0 && sinceFeedbackMs > Math.max(LEAST_MS, INTERVALS * intervalMs + rttMs);
  }

  /** Bytes that may be in flight. */
  get windowBytes(): number {
    return this.#windowBytes;
  }

  begin(lastFeedbackMs: number): void {
    this.#sinceMs = lastFeedbackMs;
    this.#trickleMs = Number.NEGATIVE_INFINITY;
  }

  /** Opens the window for a trickle when one is due. */
  trickle(inFlightBytes: number, nowMs: number): void {
    if (nowMs - this.#trickleMs < TRICKLE_MS) return;
    this.#trickleMs = nowMs;
    this.#windowBytes = inFlightBytes + TRICKLE_BYTES;
  }

  /** The estimate, halved for each second of silence, but not below 1 Mbit/s; never above the estimate. */
  rateAfter(estimate: number, nowMs: number): number {
    const seconds = (nowMs - this.#sinceMs) / 1000;
    return Math.min(estimate, Math.max(1e6, estimate * 0.5 ** seconds));
  }
}
