/**
 * Silence after which the path counts as lost, ms: points, telemetry and clock answers come many times a
 * second. Chosen: longer than a radio takes to change cells, so that restarts are rare; resume-policy.test.ts
 * holds it.
 */
export const LOST_AFTER_MS = 1000;
/** The same shortly after a change of the network, when silence is less likely to be a coincidence, ms. */
export const LOST_AFTER_CHANGE_MS = 300;
/** For how long a change of the network explains silence, ms. */
const CHANGE_COUNTS_MS = 5000;
/** The path also counts as lost if the robot has not answered our clock probes for this long, ms: it hears nothing. */
export const UNANSWERED_MS = 2500;
/** Interval between requests for an ICE restart, ms. */
export const RESUME_EVERY_MS = 1000;
/** If decisions are this far apart, the page was asleep and not cut off, ms. */
const ASLEEP_MS = 2500;

/**
 * Decides when the path to the robot counts as lost and when to ask for an ICE restart: at once, then every second for
 * as long as the session is kept. Time is an argument, ms.
 */
export class ResumePolicy {
  #heardMs = 0;
  #answeredMs = 0;
  #changedMs = Number.NEGATIVE_INFINITY;
  #nextMs = 0;
  #decidedMs: number | null = null;

  /** A path has been established. */
  begin(nowMs: number): void {
    this.#heardMs = nowMs;
    this.#answeredMs = nowMs;
    this.#nextMs = 0;
  }

  /** A packet or message came from the robot. */
  onHeard(nowMs: number): void {
    // Answers during the outage are lost; do not count them as missing.
    if (nowMs - this.#heardMs >= LOST_AFTER_MS) this.#answeredMs = nowMs;
    this.#heardMs = nowMs;
  }

  /** The robot answered a clock probe: it hears us. */
  onAnswered(nowMs: number): void {
    this.#answeredMs = nowMs;
  }

  /** The browser's network has changed or is lost. */
  onNetworkChange(nowMs: number): void {
    this.#changedMs = nowMs;
    this.#nextMs = 0;
  }

  /** Signaling to the robot works again: make the next request without waiting. */
  onSignalingBack(): void {
    this.#nextMs = 0;
  }

  silentMs(nowMs: number): number {
    return nowMs - this.#heardMs;
  }

  lost(nowMs: number): boolean {
    const changed = nowMs - this.#changedMs < CHANGE_COUNTS_MS;
    return (
      this.silentMs(nowMs) >= (changed ? LOST_AFTER_CHANGE_MS : LOST_AFTER_MS) ||
      nowMs - this.#answeredMs >= UNANSWERED_MS
    );
  }

  /** @returns whether to ask the robot for an ICE restart now; the request then counts as made */
  decide(nowMs: number, canAsk: boolean): boolean {
    const asleep = this.#decidedMs !== null && nowMs - this.#decidedMs >= ASLEEP_MS;
    this.#decidedMs = nowMs;
    if (asleep) this.begin(nowMs);
    if (!canAsk || nowMs < this.#nextMs || !this.lost(nowMs)) return false;
    this.#nextMs = nowMs + RESUME_EVERY_MS;
    return true;
  }
}
