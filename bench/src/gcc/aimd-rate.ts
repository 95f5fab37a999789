import { bitsOfBytes } from '@farpoint/timing';
import { LinkCapacity } from './link-capacity.ts';
import type { BandwidthUsage } from './overuse-detector.ts';

/** What is left of the incoming rate after over-use. */
const BETA = 0.85;
/** Growth per second, far from convergence. */
const ETA = 1.08;
/** What the controller needs beyond a round trip until it sees what it has done, ms (`response_time_ms`). */
const RESPONSE_MS = 100;
/** Over-use is not put down to the last change for longer than this, ms. */
const MOST_WAIT_MS = 200;
/** Where less than this part of the estimate arrives, it is not put down to it at all. */
const COLLAPSE = 0.5;
/** What a frame is divided into, near convergence. */
const FRAMES_PER_SECOND = 30;
const PACKET_BITS = bitsOfBytes(1200);
/** The least growth, bit/s per s near convergence; bit/s at a time far from it. */
const LEAST_ADDITIVE = 4000;
const LEAST_MULTIPLICATIVE = 1000;
/** The estimate does not grow beyond so many times the incoming rate, and a little, bit/s. */
const AHEAD = 1.5;
const AHEAD_BITS = 10_000;

/**
 * Rate control (draft-ietf-rmcat-gcc-02, section 5.5): additive or multiplicative increase, multiplicative decrease, and the
 * state machine. As in libwebrtc over-use only leads to a decrease where the estimate has not changed for a response time:
 * before that it may be what the last change has done.
 */
export class AimdRate {
  /** `A_hat`, bit/s. */
  estimate: number;
  /** `hold` while queues are being emptied. A decrease is over at once and leads to it. */
  state: 'increase' | 'hold' = 'increase';
  readonly #least: number;
  readonly #most: number;
  readonly #capacity = new LinkCapacity();
  #changedMs = Number.NEGATIVE_INFINITY;

  constructor(startBitsPerSecond: number, leastBitsPerSecond: number, mostBitsPerSecond: number) {
    this.estimate = startBitsPerSecond;
    this.#least = leastBitsPerSecond;
    this.#most = mostBitsPerSecond;
  }

  /** @param incoming `R_hat`, bit/s; NaN where it is not known */
  update(usage: BandwidthUsage, incoming: number, roundTripMs: number, nowMs: number): void {
    if (usage === 'over') {
      const waitMs = Math.min(roundTripMs + RESPONSE_MS, MOST_WAIT_MS);
      if (nowMs - this.#changedMs >= waitMs || incoming < COLLAPSE * this.estimate)
        this.#decrease(incoming, nowMs);
      return;
    }
    if (usage === 'under') {
      this.state = 'hold';
      return;
    }
    if (this.state === 'hold') {
      this.state = 'increase';
      this.#changedMs = nowMs;
    }
    this.#increase(incoming, roundTripMs, nowMs);
  }

  /** A probe has told the rate. */
  set(bitsPerSecond: number, nowMs: number): void {
    this.estimate = Math.min(Math.max(bitsPerSecond, this.#least), this.#most);
    this.#changedMs = nowMs;
  }

  #decrease(incoming: number, nowMs: number): void {
    this.state = 'hold';
    if (Number.isNaN(incoming)) {
      // Nothing is known but that it is too much.
      this.set(this.estimate / 2, nowMs);
      return;
    }
    // While a queue is emptied more arrives than is sent; then what the path was known to carry says more.
    const isMore = BETA * incoming > this.estimate && this.#capacity.isKnown;
    const full = isMore ? this.#capacity.estimate : incoming;
    if (this.#capacity.isFarAbove(incoming)) this.#capacity.reset();
    this.#capacity.add(incoming);
    this.set(Math.min(BETA * full, this.estimate), nowMs);
  }

  #increase(incoming: number, roundTripMs: number, nowMs: number): void {
    const elapsedMs = Number.isFinite(this.#changedMs) ? nowMs - this.#changedMs : 0;
    if (this.#capacity.isFarBelow(incoming)) this.#capacity.reset();
    const growth = this.#capacity.isKnown
      ? (this.#additive(roundTripMs) * elapsedMs) / 1000
      : this.#multiplicative(elapsedMs);
    const most = Number.isNaN(incoming) ? this.#most : AHEAD * incoming + AHEAD_BITS;
    this.set(Math.max(Math.min(this.estimate + growth, most), this.estimate), nowMs);
  }

  /** Half a packet per response time, bit/s per s. */
  #additive(roundTripMs: number): number {
    const frameBits = this.estimate / FRAMES_PER_SECOND;
    const packetBits = frameBits / Math.ceil(frameBits / PACKET_BITS);
    return Math.max((500 * packetBits) / (roundTripMs + RESPONSE_MS), LEAST_ADDITIVE);
  }

  #multiplicative(elapsedMs: number): number {
    return Math.max(this.estimate * (ETA ** Math.min(elapsedMs / 1000, 1) - 1), LEAST_MULTIPLICATIVE);
  }
}
