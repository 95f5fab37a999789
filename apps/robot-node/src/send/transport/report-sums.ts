import type { ReceiverSums } from '@farpoint/congestion';
import { type ReportBlock, SequenceNumber } from '@farpoint/rtp';

/**
 * Number of packets whose send time is kept. Chosen: 2 s at 41 Mbit/s, while reports come within 1.5 s; a
 * power of two.
 */
const REMEMBERED = 8192;

/**
 * Turns report blocks (RFC 3550 §6.4) into totals and round trips. A block names the highest sequence number
 * received. Packets arrive so often that the report must have left right after that packet, so the time from sending
 * the packet to receiving the report is a round trip.
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

  /** @returns `null` for a block about another stream, or an impossible one */
  read({ ssrc, packetsLost, highestSequence }: Readonly<ReportBlock>, nowMs: number): ReceiverSums | null {
    if (ssrc !== this.#ssrc || this.#first === null) return null;
    const expected = highestSequence - this.#first + 1;
    const packetsReceived = expected - packetsLost;
    if (expected < 1 || packetsReceived < 0) return null;
    // If no packet has arrived since the last report, the age of the highest one says nothing about the round trip.
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
