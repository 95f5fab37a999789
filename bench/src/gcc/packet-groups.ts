/** Packets sent within so long of their group's first one are one group, ms (`burst_time`). */
const BURST_MS = 5;
/** A group that a queue let go all at once ends after so long, ms. */
const LONGEST_BURST_MS = 100;

/**
 * Pre-filtering (draft-ietf-rmcat-gcc-02, sections 5.1 and 5.2): delay is compared from group to group, for the packets of
 * a burst tell of nothing but the burst. What a path held back and let go at once, as a radio does, joins its group too.
 */
export class PacketGroups {
  /** Between the last packets of the two newest whole groups, ms: by the sender's clock, and by the receiver's. */
  sentDeltaMs = 0;
  arrivalDeltaMs = 0;
  /** When the newest whole group was there, by the receiver's clock, ms. */
  arrivedMs = 0;
  #firstSentMs = Number.NaN;
  #firstArrivalMs = 0;
  #lastSentMs = 0;
  #lastArrivalMs = 0;
  #previousSentMs = Number.NaN;
  #previousArrivalMs = 0;

  /**
   * The next packet that arrived, in sending order.
   *
   * @returns whether it began a new group and the deltas are those of the one before it
   */
  add(sentMs: number, arrivalMs: number): boolean {
    if (Number.isNaN(this.#firstSentMs)) {
      this.#begin(sentMs, arrivalMs);
      return false;
    }
    if (sentMs < this.#firstSentMs) return false;
    if (sentMs - this.#firstSentMs <= BURST_MS || this.#isLetGo(sentMs, arrivalMs)) {
      this.#lastSentMs = Math.max(this.#lastSentMs, sentMs);
      this.#lastArrivalMs = Math.max(this.#lastArrivalMs, arrivalMs);
      return false;
    }
    const isSecond = !Number.isNaN(this.#previousSentMs);
    this.sentDeltaMs = this.#lastSentMs - this.#previousSentMs;
    this.arrivalDeltaMs = this.#lastArrivalMs - this.#previousArrivalMs;
    this.arrivedMs = this.#lastArrivalMs;
    this.#previousSentMs = this.#lastSentMs;
    this.#previousArrivalMs = this.#lastArrivalMs;
    this.#begin(sentMs, arrivalMs);
    return isSecond;
  }

  reset(): void {
    this.#firstSentMs = Number.NaN;
    this.#previousSentMs = Number.NaN;
  }

  #begin(sentMs: number, arrivalMs: number): void {
    this.#firstSentMs = sentMs;
    this.#lastSentMs = sentMs;
    this.#firstArrivalMs = arrivalMs;
    this.#lastArrivalMs = arrivalMs;
  }

  /** It left together with the group's last packet, or came hard upon it after less delay. */
  #isLetGo(sentMs: number, arrivalMs: number): boolean {
    if (sentMs === this.#lastSentMs) return true;
    const sinceMs = arrivalMs - this.#lastArrivalMs;
    return (
      sinceMs <= BURST_MS &&
      sinceMs < sentMs - this.#lastSentMs &&
      arrivalMs - this.#firstArrivalMs < LONGEST_BURST_MS
    );
  }
}
