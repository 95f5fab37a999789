/** Silence from which the path counts as lost, ms: points, telemetry and clock answers come many times a second. */
export const LOST_AFTER_MS = 1000;
/** The same just after the network has changed: then it is no accident. */
export const LOST_AFTER_CHANGE_MS = 300;
const CHANGE_COUNTS_MS = 5000;
/** The robot is heard, but hears nothing: so long its answers to our clock probes stay away, ms. */
export const UNANSWERED_MS = 2500;
/** From one request for an ICE restart to the next, ms. */
export const RESUME_EVERY_MS = 1000;
/** Who was not called for so long was asleep, not cut off, ms. */
const ASLEEP_MS = 2500;

/**
 * When the path to the robot counts as lost and the robot is asked for an ICE restart: at once, and again each second for as
 * long as the session is kept. Time is an argument, ms.
 */
export class ResumePolicy {
  #heardMs = 0;
  #answeredMs = 0;
  #changedMs = Number.NEGATIVE_INFINITY;
  #nextMs = 0;
  #tickMs: number | null = null;

  /** A path stands. */
  begin(nowMs: number): void {
    this.#heardMs = nowMs;
    this.#answeredMs = nowMs;
    this.#nextMs = 0;
  }

  /** Any packet or message of the robot. */
  onHeard(nowMs: number): void {
    // Answers to what was sent meanwhile are lost.
    if (nowMs - this.#heardMs >= LOST_AFTER_MS) this.#answeredMs = nowMs;
    this.#heardMs = nowMs;
  }

  /** The robot answered a clock probe: it hears us. */
  onAnswered(nowMs: number): void {
    this.#answeredMs = nowMs;
  }

  /** The browser has another network, or none. */
  onNetworkChange(nowMs: number): void {
    this.#changedMs = nowMs;
    this.#nextMs = 0;
  }

  /** The way to the robot by signaling stands anew: do not wait any longer. */
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

  /** @returns whether to ask the robot for an ICE restart now; it then counts as asked */
  tick(nowMs: number, canAsk: boolean): boolean {
    const asleep = this.#tickMs !== null && nowMs - this.#tickMs >= ASLEEP_MS;
    this.#tickMs = nowMs;
    if (asleep) this.begin(nowMs);
    if (!canAsk || nowMs < this.#nextMs || !this.lost(nowMs)) return false;
    this.#nextMs = nowMs + RESUME_EVERY_MS;
    return true;
  }
}
