/** Packets sent within this time of their group's first packet form one group, ms (`burst_time`). */
const BURST_MS = 5;
/** Longest duration of a group that a queue releases at once, ms. */
const LONGEST_BURST_MS = 100;

/**
 * Pre-filtering (draft-ietf-rmcat-gcc-02, sections 5.1 and 5.2). Delay is compared from group to group, because the
 * packets of a burst show only the burst itself. Packets that a path, such as a radio link, holds back and releases
 * at once join their group, too.
 */
export class PacketGroups {
  /**
   * Time between the last packets of the two newest complete groups, ms, on the sender's clock and on the receiver's.
   */
  sentDeltaMs = 0;
  arrivalDeltaMs = 0;
  /** When the newest complete group arrived, on the receiver's clock, ms. */
  arrivedMs = 0;
  #firstSentMs = Number.NaN;
  #firstArrivalMs = 0;
  #lastSentMs = 0;
  #lastArrivalMs = 0;
  #previousSentMs = Number.NaN;
  #previousArrivalMs = 0;

  /**
   * Adds the next packet that arrived, in sending order.
   *
   * @returns whether it began a new group, so that the deltas are those of the previous one
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

  /** Whether it was sent together with the group's last packet, or followed it closely with less delay. */
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
