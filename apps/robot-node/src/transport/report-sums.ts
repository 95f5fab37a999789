import type { ReceiverSums } from '@farpoint/congestion';
import { type ReportBlock, SequenceNumber } from '@farpoint/rtp';

/** Packets whose sending is remembered: several seconds of any stream that such reports allow. */
const REMEMBERED = 8192;

/**
 * Turns report blocks (RFC 3550 §6.4) into sums and round trips. A block names the highest number that came, and packets come
 * so often that the report left right after it: from sending that packet to hearing of it is a round trip.
 */
export class ReportSums {
  readonly #ssrc: number;
  readonly #sentMs = new Float64Array(REMEMBERED).fill(Number.NaN);
  readonly #sequences = new Uint16Array(REMEMBERED);
  #first: number | null = null;
  #highest = -1;

  constructor(ssrc: number) {
    this.#ssrc = ssrc;
  }

  /** @param sequence RTP sequence number */
  onSent(sequence: number, nowMs: number): void {
    this.#first ??= sequence;
    this.#sentMs[sequence % REMEMBERED] = nowMs;
    this.#sequences[sequence % REMEMBERED] = sequence;
  }

  /** @returns `null` for a block about another stream, or one that cannot be right */
  read({ ssrc, packetsLost, highestSequence }: Readonly<ReportBlock>, nowMs: number): ReceiverSums | null {
    if (ssrc !== this.#ssrc || this.#first === null) return null;
    const expected = highestSequence - this.#first + 1;
    const packetsReceived = expected - packetsLost;
    if (expected < 1 || packetsReceived < 0) return null;
    // Where nothing came since the last report, how long ago that packet left says nothing.
    let rttMs: number | null = null;
    if (highestSequence > this.#highest) {
      this.#highest = highestSequence;
      const sequence = SequenceNumber.of(highestSequence);
      const at = sequence % REMEMBERED;
      const sentMs = this.#sequences[at] === sequence ? this.#sentMs[at]! : Number.NaN;
      if (!Number.isNaN(sentMs)) rttMs = nowMs - sentMs;
    }
    return { packetsReceived, packetsLost, source: 'rtcp', rttMs };
  }
}
