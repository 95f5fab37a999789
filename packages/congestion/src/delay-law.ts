import { BitRate } from '@farpoint/timing';
import type { PathObservation, PathObserver } from './path-observer.ts';

// What these numbers give together with the others: see adaptive-rate-controller.ts.

/** Size of a typical packet on the wire. */
const PACKET_BYTES = 1250;
/** The estimate becomes this fraction of the rate that arrived while the queue stood. */
const KEEP = 0.96;
/** The window over which the rate is measured: for the first message of a queue, and for later ones, ms. */
const FIRST_WINDOW_MS = 20;
const WINDOW_MS = 40;
/** A gap this long between two arrivals indicates a stall, not a slow link, ms. */
const HALT_MS = 8;
/** After this many messages, a queue no longer counts as young. */
const LONG_QUEUED = 6;
/** If one packet takes longer than this, only the total arrival rate is meaningful, ms. */
const SLOW_PACKET_MS = 2.5;
/** A standing queue should be drained within this time, ms; at most this fraction of the rate is held back for it. */
const DRAIN_MS = 150;
const DRAIN_MOST = 0.6;
/** Above this noise, a single message proves nothing, ms. */
const NOISY_MS = 2;

/**
 * Queueing delay that is tolerated, ms. It is larger at low rates, so that the smaller of two flows keeps growing when
 * the larger one has to yield, and the two converge to the same rate.
 */
export function toleratedQueueMs(bitsPerSecond: number): number {
  return Math.min(Math.max(8 * Math.cbrt(20e6 / bitsPerSecond), 6), 25) + packetMs(bitsPerSecond);
}

/** Time that one packet takes on a link of this rate, ms. */
export function packetMs(bitsPerSecond: number): number {
  return BitRate.msFor(bitsPerSecond, PACKET_BYTES);
}

/** The part of the delay that may be noise, ms. */
export function noiseAllowanceMs(noiseMs: number): number {
  return 5 * Math.max(noiseMs - 1, 0);
}

/**
 * Growth, bit/s per s. It follows the square root of the rate, so that a small flow catches up with a large one; it is
 * bounded for slow links.
 */
export function growth(bitsPerSecond: number): number {
  return Math.min(0.4e6 * Math.sqrt(BitRate.toMbps(bitsPerSecond)), Math.max(0.25 * bitsPerSecond, 0.1e6));
}

/** What the delay indicates. `over`: the queue is longer than tolerated; `clear`: it is (nearly) empty. */
export type DelayReading = 'over' | 'between' | 'clear';

/** Judges the delay of each message, and reduces the estimate when the delay is too long. */
export class DelayLaw {
  #overInRow = 0;
  #lastQueued = Number.NaN;

  read(
    o: Readonly<PathObservation>,
    toleratedMs: number,
    allowanceMs: number,
    noiseMs: number,
  ): DelayReading {
    // The queue that most of the message saw, unless it has drained since.
    const queue = Math.min(o.queueMs, o.queueEndMs * 1.5 + 2);
    this.#overInRow = queue > toleratedMs || o.queueEndMs > 1.5 * toleratedMs ? this.#overInRow + 1 : 0;
    if (this.#overInRow >= (noiseMs > NOISY_MS ? 2 : 1) || o.queueEndMs > 2.5 * toleratedMs) return 'over';
    return queue < (toleratedMs + allowanceMs) / 2 ? 'clear' : 'between';
  }

  /**
   * While the queue stands, the arrival rate is the rate that the path carries for us. A queue alone does not prove a
   * lower rate, because everything may have stalled for a moment. Therefore only rates measured while the queue stood
   * count, at first the highest of them. The overall arrival rate counts only if the queue stays and gives no such
   * rate.
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

  /** The fraction of the rate to hold back until the queue has drained. */
  drain(o: Readonly<PathObservation>, allowanceMs: number): number {
    return Math.min(Math.max(o.queueEndMs - allowanceMs - 2, 0) / DRAIN_MS, DRAIN_MOST);
  }
}
