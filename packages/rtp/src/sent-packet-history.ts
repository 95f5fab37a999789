import { SequenceNumber } from './sequence-number.ts';

export interface SentPacket {
  bytes: number;
  sentMs: number;
}

/**
 * Remembers the most recently sent packets by transport-wide sequence number. Bounded: a ring of preallocated columns,
 * in which a packet replaces the one `capacity` numbers before it.
 */
export class SentPacketHistory {
  readonly #mask: number;
  readonly #maxAgeMs: number;
  readonly #sequences: Int32Array;
  readonly #bytes: Uint32Array;
  readonly #sentMs: Float64Array;

  /**
   * @param capacity power of two, at most 65536; at 10,000 packets/s, 16384 are 1.6 s
   * @param maxAgeMs older packets are forgotten, because their number may be in use again
   */
  constructor(capacity = 16_384, maxAgeMs = 5000) {
    if (capacity < 1 || capacity > 65_536 || (capacity & (capacity - 1)) !== 0) {
      throw new RangeError(`capacity ${capacity} is not a power of two up to 65536`);
    }
    this.#mask = capacity - 1;
    this.#maxAgeMs = maxAgeMs;
    this.#sequences = new Int32Array(capacity).fill(-1);
    this.#bytes = new Uint32Array(capacity);
    this.#sentMs = new Float64Array(capacity);
  }

  add(transportSequence: number, bytes: number, nowMs: number): void {
    const at = transportSequence & this.#mask;
    this.#sequences[at] = SequenceNumber.of(transportSequence);
    this.#bytes[at] = bytes;
    this.#sentMs[at] = nowMs;
  }

  /** Finds a packet and forgets it, so that a packet reported twice counts once. */
  take(transportSequence: number, nowMs: number): SentPacket | null {
    const at = transportSequence & this.#mask;
    if (this.#sequences[at] !== SequenceNumber.of(transportSequence)) return null;
    this.#sequences[at] = -1;
    const sentMs = this.#sentMs[at] as number;
    if (nowMs - sentMs > this.#maxAgeMs) return null;
    return { bytes: this.#bytes[at] as number, sentMs };
  }
}
