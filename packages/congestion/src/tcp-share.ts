import { BitRate } from '@farpoint/timing';

/** CUBIC's constants (RFC 9438 §4.1, §4.6), in segments. */
const C = 0.4;
const BETA = 0.7;
const SEGMENT_BYTES = 1500;

/**
 * The window of a TCP flow with CUBIC (RFC 9438) that would compete in our place: the fair share while somebody else
 * keeps the queue full.
 */
export class TcpShare {
  #window = 10;
  #windowMax = 10;
  #friendly = 10;
  #epochMs = 0;
  #k = 0;
  #reducedMs = Number.NEGATIVE_INFINITY;

  get windowBytes(): number {
    return this.#window * SEGMENT_BYTES;
  }

  /** Starts with the window that `bitsPerSecond` needs at this round trip. */
  start(bitsPerSecond: number, rttMs: number, nowMs: number): void {
    this.#window = Math.max(BitRate.bytesIn(bitsPerSecond, rttMs) / SEGMENT_BYTES, 2);
    this.#windowMax = this.#window;
    this.#begin(nowMs);
  }

  /**
   * @param congested whether there is loss beyond the link's own
   * @param newestSentMs losses of packets sent before the last reduction took effect do not count again
   */
  update(rttMs: number, congested: boolean, newestSentMs: number, elapsedMs: number, nowMs: number): void {
    if (congested) {
      if (newestSentMs <= this.#reducedMs) return;
      this.#reducedMs = nowMs;
      this.#windowMax = this.#window < this.#windowMax ? (this.#window * (1 + BETA)) / 2 : this.#window;
      this.#window = Math.max(this.#window * BETA, 2);
      this.#begin(nowMs);
      return;
    }
    const t = (nowMs - this.#epochMs + rttMs) / 1000;
    const cubic = this.#windowMax + C * (t - this.#k) ** 3;
    this.#friendly += (((3 * (1 - BETA)) / (1 + BETA)) * elapsedMs) / rttMs;
    const goal = Math.max(Math.min(cubic, 1.5 * this.#window), this.#friendly);
    if (goal > this.#window) this.#window += (goal - this.#window) * Math.min(elapsedMs / rttMs, 1);
  }

  #begin(nowMs: number): void {
    this.#epochMs = nowMs;
    this.#friendly = this.#window;
    this.#k = Math.cbrt((this.#windowMax - this.#window) / C);
  }
}
