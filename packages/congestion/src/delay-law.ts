import { BitRate } from '@farpoint/timing';
import type { PathObservation, PathObserver } from './path-observer.ts';

/** Of a typical packet on the wire. */
const PACKET_BYTES = 1250;
/** Of what got through while the queue stood, the part that is planned for. */
const KEEP = 0.96;
/** Over how long the rate is told: of a queue's first message, and of later ones, ms. */
const FIRST_WINDOW_MS = 20;
const WINDOW_MS = 40;
/** A gap between two arrivals that tells of a halt and not of a slow link, ms. */
const HALT_MS = 8;
/** After so many messages a queue is not young. */
const LONG_QUEUED = 6;
/** On so slow a link only the sum tells the rate: a packet's time, ms. */
const SLOW_PACKET_MS = 2.5;
/** A standing queue should be gone after this time, ms; at most this part of the rate is held back for it. */
const DRAIN_MS = 150;
const DRAIN_MOST = 0.6;
/** Noise from which on one message is no proof, ms. */
const NOISY_MS = 2;

/**
 * Queueing delay that is tolerated, ms. More at low rates: so the smaller one of two flows goes on growing when the larger
 * one has to yield, and they come to the same rate.
 */
export function toleratedQueueMs(bitsPerSecond: number): number {
  return Math.min(Math.max(8 * Math.cbrt(20e6 / bitsPerSecond), 6), 25) + packetMs(bitsPerSecond);
}

/** A packet's own time on a link of this rate, ms. */
export function packetMs(bitsPerSecond: number): number {
  return BitRate.msFor(bitsPerSecond, PACKET_BYTES);
}

/** How much of the delay may be noise, ms. */
export function noiseAllowanceMs(noiseMs: number): number {
  return 5 * Math.max(noiseMs - 1, 0);
}

/** Growth, bit/s per s: with the square root of the rate, so that a small flow gains on a large one; bounded for slow links. */
export function growth(bitsPerSecond: number): number {
  return Math.min(0.4e6 * Math.sqrt(BitRate.toMbps(bitsPerSecond)), Math.max(0.25 * bitsPerSecond, 0.1e6));
}

/** How the delay reads: `over`, the queue is longer than tolerated; `clear`, it is (nearly) empty. */
export type DelayReading = 'over' | 'between' | 'clear';

/** Judges each message's delay, and says what is left of the estimate when it is over. */
export class DelayLaw {
  #overInRow = 0;
  #lastQueued = Number.NaN;

  read(
    o: Readonly<PathObservation>,
    toleratedMs: number,
    allowanceMs: number,
    noiseMs: number,
  ): DelayReading {
    // The queue as most of the message saw it, unless it has gone meanwhile.
    const queue = Math.min(o.queueMs, o.queueEndMs * 1.5 + 2);
    this.#overInRow = queue > toleratedMs || o.queueEndMs > 1.5 * toleratedMs ? this.#overInRow + 1 : 0;
    if (this.#overInRow >= (noiseMs > NOISY_MS ? 2 : 1) || o.queueEndMs > 2.5 * toleratedMs) return 'over';
    return queue < (toleratedMs + allowanceMs) / 2 ? 'clear' : 'between';
  }

  /**
   * While the queue stands, what arrives is the path's rate for us. A queue is no proof of a lower rate: everything may have
   * stood still for a moment. So a rate counts that held while the queue stood, the most generous one at first; and what
   * arrived over all only when the queue stays and tells no such rate.
   */
  estimateWhenOver(path: PathObserver, estimate: number, toleratedMs: number): number {
    const { ackedBitsPerSecond: acked, queueEndMs } = path.observation;
    const first = this.#overInRow <= 1;
    const leastMs = toleratedMs / 2;
    const queued = first
      ? path.rateWhileQueued(leastMs, FIRST_WINDOW_MS, HALT_MS)
      : path.rateWhileQueued(leastMs, WINDOW_MS);
    let rate: number;
    if (packetMs(estimate) > SLOW_PACKET_MS) rate = Number.isNaN(queued) ? acked : queued;
    else if (Number.isNaN(queued)) {
      const old = this.#overInRow >= LONG_QUEUED && queueEndMs > toleratedMs;
      rate = old ? acked : estimate / KEEP;
    } else rate = first || Number.isNaN(this.#lastQueued) ? queued : Math.max(queued, this.#lastQueued);
    this.#lastQueued = queued;
    rate = Math.max(rate, 0.5 * acked);
    const floor = path.noiseMs > NOISY_MS && queueEndMs < 2.5 * toleratedMs ? 0.85 * estimate : 0;
    return Math.min(estimate, Math.max(KEEP * rate, floor));
  }

  /** The part of the rate that is held back until the queue has gone. */
  drain(o: Readonly<PathObservation>, allowanceMs: number): number {
    return Math.min(Math.max(o.queueEndMs - allowanceMs - 2, 0) / DRAIN_MS, DRAIN_MOST);
  }
}
