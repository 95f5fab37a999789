/** Feedback is missed when so many of its intervals, and so long, have passed without any. */
const INTERVALS = 4;
const LEAST_MS = 500;
/** So many bytes may go out each so often, to learn when the path is back. */
const TRICKLE_BYTES = 10_000;
const TRICKLE_MS = 500;

/** The time without feedback: what may still be sent, and at what rate to begin afterwards. */
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

  onTick(inFlightBytes: number, nowMs: number): void {
    if (nowMs - this.#trickleMs < TRICKLE_MS) return;
    this.#trickleMs = nowMs;
    this.#windowBytes = inFlightBytes + TRICKLE_BYTES;
  }

  /** Halved for each second of silence; never more than before, and not below 1 Mbit/s on that account. */
  rateAfter(estimate: number, nowMs: number): number {
    const seconds = (nowMs - this.#sinceMs) / 1000;
    return Math.min(estimate, Math.max(1e6, estimate * 0.5 ** seconds));
  }
}
