import { SequenceNumber } from '@farpoint/rtp';

/**
 * Tracks what has been sent and not yet reported: cumulative bytes by transport-wide sequence number, in preallocated
 * rings. A packet counts as answered as soon as feedback names it or a later one. A lost feedback message thus does not
 * leave its packets in flight for ever.
 */
export class InFlight {
  static readonly #CAPACITY = 1 << 15;
  static readonly #MASK = InFlight.#CAPACITY - 1;
  /** Bytes sent up to and including the packet. */
  readonly #sums = new Float64Array(InFlight.#CAPACITY);
  readonly #clusters = new Int32Array(InFlight.#CAPACITY);
  #sent = 0;
  #answered = 0;
  #newestAnswered = -1;

  onSent(transportSequence: number, bytes: number, probeCluster: number): void {
    const at = transportSequence & InFlight.#MASK;
    this.#sent += bytes;
    this.#sums[at] = this.#sent;
    this.#clusters[at] = probeCluster;
  }

  onAnswered(transportSequence: number): void {
    const newest = this.#newestAnswered;
    if (newest >= 0 && SequenceNumber.ahead(transportSequence, newest) < 0) return;
    this.#newestAnswered = SequenceNumber.of(transportSequence);
    this.#answered = Math.max(this.#answered, this.#sums[transportSequence & InFlight.#MASK] as number);
  }

  clusterOf(transportSequence: number): number {
    return this.#clusters[transportSequence & InFlight.#MASK] as number;
  }

  /** Total sent so far, bytes. */
  get sentBytes(): number {
    return this.#sent;
  }

  get bytes(): number {
    return this.#sent - this.#answered;
  }
}
