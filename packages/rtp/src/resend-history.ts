/** Why a requested packet is not sent again. */
export type ResendRefusal =
  | 'unknown' // never sent, or so long ago that it has been forgotten
  | 'too-late' // its content would be outdated when it arrives
  | 'resent'; // a resent copy is already on its way

interface Entry<T> {
  sequence: number;
  sentMs: number;
  usefulUntilMs: number;
  packet: T;
}

/**
 * The most recently sent packets, to be resent if they can still arrive in time. A packet of a cloud is shown until the
 * next frame's packet for the same place arrives; resent later than that, it is useless. Bounded: a ring in which a
 * newer packet replaces the oldest.
 */
export class ResendHistory<T> {
  readonly #entries: (Entry<T> | undefined)[];
  readonly #mask: number;
  /** How often a packet was not resent, by reason. */
  readonly refusals: Record<ResendRefusal, number> = { unknown: 0, 'too-late': 0, resent: 0 };

  /** @param capacity packets, a power of two, at most 32768 */
  constructor(capacity = 1024) {
    if (capacity < 1 || capacity > 32_768 || (capacity & (capacity - 1)) !== 0) {
      throw new RangeError(`capacity ${capacity} is not a power of two up to 32768`);
    }
    this.#mask = capacity - 1;
    this.#entries = new Array<Entry<T> | undefined>(capacity);
  }

  /** @param usefulMs time until the next frame's packet for the same place is sent, ms */
  add(sequence: number, packet: T, sentMs: number, usefulMs: number): void {
    const at = sequence & this.#mask;
    const entry = this.#entries[at];
    const usefulUntilMs = sentMs + usefulMs;
    if (entry === undefined) this.#entries[at] = { sequence, sentMs, usefulUntilMs, packet };
    else {
      entry.sequence = sequence;
      entry.sentMs = sentMs;
      entry.usefulUntilMs = usefulUntilMs;
      entry.packet = packet;
    }
  }

  /** @returns the packet to resend now; `null` if that is no use, counted in {@link refusals} */
  take(sequence: number, nowMs: number): T | null {
    const at = sequence & this.#mask;
    const entry = this.#entries[at];
    if (entry === undefined || entry.sequence !== sequence) return this.#refuse('unknown');
    if (nowMs >= entry.usefulUntilMs) return this.#refuse('too-late');
    if (Number.isNaN(entry.sentMs)) return this.#refuse('resent');
    entry.sentMs = Number.NaN;
    return entry.packet;
  }

  #refuse(reason: ResendRefusal): null {
    this.refusals[reason]++;
    return null;
  }
}
