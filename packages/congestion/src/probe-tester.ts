import type { PacketResult } from '@farpoint/rtp';
import { BitRate } from '@farpoint/timing';
import type { InFlight } from './in-flight.ts';
import type { ProbeRequest } from './rate-controller.ts';

export interface ProbeOutcome {
  /** Measured sending rate of the train, bit/s. */
  sentBitsPerSecond: number;
  /** Arrival rate of the train, bit/s. */
  arrivedBitsPerSecond: number;
}

// What these numbers give together with the others: see adaptive-rate-controller.ts.

/** With fewer packets that arrived, a train tells no rate. */
const LEAST_PACKETS = 5;
/** A requested train that has not been seen for this long is given up, ms. */
const PATIENCE_MS = 400;

/** Handles one train of packets at a time: requests it, finds it in the feedback, measures its spread. */
export class ProbeTester {
  #request: ProbeRequest | null = null;
  #askedMs = 0;
  #cluster = 0;
  #packets = 0;
  #bytes = 0;
  #firstBytes = 0;
  #firstSentMs = 0;
  #lastSentMs = 0;
  #firstArrivalMs = 0;
  #lastArrivalMs = 0;
  #sentBytes = 0;
  #sentFirstMs = 0;
  readonly outcome: ProbeOutcome = { sentBitsPerSecond: 0, arrivedBitsPerSecond: 0 };

  /** What is still to be sent; `null` for nothing. */
  get wish(): Readonly<ProbeRequest> | null {
    return this.#request !== null && this.#sentBytes < this.#request.bytes ? this.#request : null;
  }

  get busy(): boolean {
    return this.#request !== null;
  }

  ask(bitsPerSecond: number, bytes: number, nowMs: number): void {
    this.#request = { clusterId: ++this.#cluster, bitsPerSecond, bytes };
    this.#askedMs = nowMs;
    this.#packets = 0;
    this.#bytes = 0;
    this.#sentBytes = 0;
  }

  cancel(): void {
    this.#request = null;
  }

  onSent(bytes: number, probeCluster: number, nowMs: number): void {
    if (probeCluster !== this.#request?.clusterId) return;
    if (this.#sentBytes === 0) this.#sentFirstMs = nowMs;
    this.#sentBytes += bytes;
  }

  /** Gives up a train that takes too long. @returns whether it is one that nobody began to send */
  expire(nowMs: number, roundTripMs: number): boolean {
    if (this.#request === null) return false;
    const since = this.#sentBytes > 0 ? this.#sentFirstMs : this.#askedMs;
    if (nowMs - since <= PATIENCE_MS + 2 * roundTripMs) return false;
    this.#request = null;
    return this.#sentBytes === 0;
  }

  /** @returns the train's outcome, once feedback has passed its end */
  onFeedback(results: readonly PacketResult[], inFlight: InFlight): ProbeOutcome | null {
    const request = this.#request;
    if (request === null) return null;
    let past = false;
    for (const { transportSequence, bytes, sentMs, arrivalUs } of results) {
      if (inFlight.clusterOf(transportSequence) !== request.clusterId) {
        past = this.#packets > 0;
        continue;
      }
      if (arrivalUs === null) continue;
      const arrivalMs = arrivalUs / 1000;
      if (this.#packets === 0) {
        this.#firstSentMs = sentMs;
        this.#firstArrivalMs = arrivalMs;
        this.#firstBytes = bytes;
      }
      this.#packets++;
      this.#bytes += bytes;
      this.#lastSentMs = sentMs;
      this.#lastArrivalMs = Math.max(arrivalMs, this.#packets === 1 ? arrivalMs : this.#lastArrivalMs);
    }
    if (!past) return null;
    this.#request = null;
    const bytes = this.#bytes - this.#firstBytes;
    const sentMs = this.#lastSentMs - this.#firstSentMs;
    const arrivedMs = this.#lastArrivalMs - this.#firstArrivalMs;
    if (this.#packets < LEAST_PACKETS || sentMs <= 0 || arrivedMs <= 0) return null;
    this.outcome.sentBitsPerSecond = BitRate.of(bytes, sentMs);
    this.outcome.arrivedBitsPerSecond = BitRate.of(bytes, arrivedMs);
    return this.outcome;
  }
}
