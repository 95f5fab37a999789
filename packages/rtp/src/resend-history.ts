/** Why a requested packet is not sent again. */
export type ResendRefusal =
  | 'unknown' // never sent, or so long ago that it has been forgotten
  | 'too-late' // its content would be outdated when it arrives
  | 'resent'; // a resent copy is already on its way

/** Longest packet that is kept, bytes: none is longer than what Ethernet carries. */
export const MOST_PACKET_BYTES = 1500;

/**
 * The most recently sent packets, to be resent if they can still arrive in time. A packet of a cloud is shown until the
 * next frame's packet for the same place arrives; resent later than that, it is useless. Bounded: a ring in which a
 * newer packet replaces the oldest.
 *
 * Packets are copied into memory of its own: thousands a second that were kept as objects for a second each would be moved
 * about by the garbage collector, and have it search the whole heap once a second.
 */
export class ResendHistory {
  readonly #mask: number;
  /** Of each place: the packet's sequence number; -1: none. */
  readonly #sequences: Int32Array;
  readonly #lengths: Uint16Array;
  /** Until when it is of use, ms. */
  readonly #usefulUntilMs: Float64Array;
  readonly #resent: Uint8Array;
  #bytes: Uint8Array | null = null;
  /** How often a packet was not resent, by reason. */
  readonly refusals: Record<ResendRefusal, number> = { unknown: 0, 'too-late': 0, resent: 0 };

  /** @param capacity packets, a power of two, at most 32768 */
  constructor(capacity = 1024) {
    if (capacity < 1 || capacity > 32_768 || (capacity & (capacity - 1)) !== 0) {
      throw new RangeError(`capacity ${capacity} is not a power of two up to 32768`);
    }
    this.#mask = capacity - 1;
    this.#sequences = new Int32Array(capacity).fill(-1);
    this.#lengths = new Uint16Array(capacity);
    this.#usefulUntilMs = new Float64Array(capacity);
    this.#resent = new Uint8Array(capacity);
  }

  /**
   * Keeps a packet. One longer than {@link MOST_PACKET_BYTES} is not kept.
   *
   * @param parts of the packet, in order @param usefulMs time until the next frame's packet for the same place is sent, ms
   */
  add(sequence: number, parts: readonly Uint8Array[], sentMs: number, usefulMs: number): void {
    const place = sequence & this.#mask;
    let length = 0;
    for (const part of parts) length += part.length;
    if (length > MOST_PACKET_BYTES) {
      this.#sequences[place] = -1;
      return;
    }
    // A stream of which nothing is sent takes no memory.
    this.#bytes ??= new Uint8Array((this.#mask + 1) * MOST_PACKET_BYTES);
    let at = place * MOST_PACKET_BYTES;
    for (const part of parts) {
      this.#bytes.set(part, at);
      at += part.length;
    }
    this.#sequences[place] = sequence;
    this.#lengths[place] = length;
    this.#usefulUntilMs[place] = sentMs + usefulMs;
    this.#resent[place] = 0;
  }

  /** @returns a copy of the packet to resend now; `null` if that is no use, counted in {@link refusals} */
  take(sequence: number, nowMs: number): Uint8Array | null {
    const place = sequence & this.#mask;
    if (this.#bytes === null || this.#sequences[place] !== sequence) return this.#refuse('unknown');
    if (nowMs >= (this.#usefulUntilMs[place] as number)) return this.#refuse('too-late');
    if (this.#resent[place] === 1) return this.#refuse('resent');
    this.#resent[place] = 1;
    const at = place * MOST_PACKET_BYTES;
    return this.#bytes.slice(at, at + (this.#lengths[place] as number));
  }

  #refuse(reason: ResendRefusal): null {
    this.refusals[reason]++;
    return null;
  }
}
