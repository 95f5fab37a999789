import { bitsOfBytes } from '@farpoint/timing';
import { LinkCapacity } from './link-capacity.ts';
import type { BandwidthUsage } from './overuse-detector.ts';

/** Factor applied to the incoming rate after over-use. */
const BETA = 0.85;
/** Growth factor per second, far from convergence. */
const ETA = 1.08;
/** Time beyond a round trip until the controller sees its own effect, ms (`response_time_ms`). */
const RESPONSE_MS = 100;
/** Over-use is attributed to the last change for no longer than this, ms. */
const MOST_WAIT_MS = 200;
/** If less than this share of the estimate arrives, over-use is not attributed to the last change at all. */
const COLLAPSE = 0.5;
/** Assumed frame rate for the size of a packet near convergence. */
const FRAMES_PER_SECOND = 30;
const PACKET_BITS = bitsOfBytes(1200);
/** Minimum growth: bit/s per s near convergence; bit/s per update far from it. */
const LEAST_ADDITIVE = 4000;
const LEAST_MULTIPLICATIVE = 1000;
/** The estimate does not exceed the incoming rate times this factor, plus AHEAD_BITS bit/s. */
const AHEAD = 1.5;
const AHEAD_BITS = 10_000;

/**
 * Rate control (draft-ietf-rmcat-gcc-02, section 5.5): additive or multiplicative increase, multiplicative decrease,
 * and the state machine. As in libwebrtc, over-use leads to a decrease only if the estimate has not changed for a
 * response time. Before that, it may be the result of the last change.
 */
export class AimdRate {
  /** `A_hat`, bit/s. */
  estimate: number;
  /** `hold` while queues drain. A decrease takes effect immediately and leads to `hold`. */
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

  /** @param incoming `R_hat`, bit/s; NaN if unknown */
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

  /** Sets the rate that a probe has found. */
  set(bitsPerSecond: number, nowMs: number): void {
    this.estimate = Math.min(Math.max(bitsPerSecond, this.#least), this.#most);
    this.#changedMs = nowMs;
  }

  #decrease(incoming: number, nowMs: number): void {
    this.state = 'hold';
    if (Number.isNaN(incoming)) {
      // All that is known is that the rate is too high.
      this.set(this.estimate / 2, nowMs);
      return;
    }
    // While a queue drains, more arrives than is sent. The known capacity of the path is then a better guide.
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
