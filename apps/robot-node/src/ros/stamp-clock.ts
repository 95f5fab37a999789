import { capturedAtMs, type RosClock } from './capture-time.ts';

/** The least delay of the last one to two of these counts, ms. */
const WINDOW_MS = 10_000;
/** Stamps that go back by more than this are of another clock, ms. */
const RESTART_MS = 1000;

/**
 * When what a topic's messages hold was captured, for those who must notice that it arrives late. Stamps of this machine's
 * clock are taken at their word. With another clock, nobody knows the delay, but how much longer it is than the shortest
 * one of the last seconds: a topic that falls behind is noticed, one that is always late is not.
 */
export class StampClock {
  readonly #clock: RosClock;
  #lastNs: bigint | null = null;
  /** The shortest from stamp to arrival in the present window and in the one before, ms. */
  #least = Number.POSITIVE_INFINITY;
  #leastBefore = Number.POSITIVE_INFINITY;
  #windowMs = Number.NEGATIVE_INFINITY;

  constructor(clock: RosClock) {
    this.#clock = clock;
  }

  /**
   * @param receivedMs the robot's clock
   * @returns when it was captured, robot's clock, ms; `null` for a message that is not newer than the last
   */
  capturedAtMs(stampNs: bigint, receivedMs: number): number | null {
    // Some drivers do not stamp.
    if (stampNs === 0n) return receivedMs;
    const backMs = this.#lastNs === null ? 0 : Number(this.#lastNs - stampNs) / 1e6;
    if (this.#lastNs !== null && backMs >= 0) {
      if (backMs <= RESTART_MS) return null;
      this.#forget();
    }
    this.#lastNs = stampNs;
    const offsetMs = receivedMs - Number(stampNs) / 1e6;
    if (receivedMs - this.#windowMs > WINDOW_MS) {
      this.#leastBefore = receivedMs - this.#windowMs > 2 * WINDOW_MS ? offsetMs : this.#least;
      this.#least = offsetMs;
      this.#windowMs = receivedMs;
    }
    this.#least = Math.min(this.#least, offsetMs);
    const late = receivedMs - (offsetMs - Math.min(this.#least, this.#leastBefore));
    return Math.min(late, capturedAtMs(this.#clock, stampNs, receivedMs), receivedMs);
  }

  #forget(): void {
    [this.#least, this.#leastBefore] = [Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY];
    this.#windowMs = Number.NEGATIVE_INFINITY;
  }
}
