import { SentPacketHistory } from './sent-packet-history.ts';
import type { TransportFeedback } from './transport-feedback.ts';

/** What became of one packet, according to transport-wide feedback. */
export interface PacketResult {
  transportSequence: number;
  bytes: number;
  sentMs: number;
  /** The receiver's clock, µs, continuous across feedback messages; only differences are meaningful. `null`: lost. */
  arrivalUs: number | null;
}

/** The reference time has 24 bits, in units of 64 ms. */
const REFERENCE_WRAP_US = 2 ** 24 * 64_000;

/** Joins transport-wide feedback with the history of sent packets, and makes the arrival times continuous. */
export class TransportFeedbackAdapter {
  readonly #history: SentPacketHistory;
  #lastReferenceUs: number | null = null;
  #wrapsUs = 0;
  /** Packets named in feedback that are not in the history: reported twice, too old, or never sent. */
  unknownPackets = 0;

  constructor(history: SentPacketHistory = new SentPacketHistory()) {
    this.#history = history;
  }

  onPacketSent(transportSequence: number, bytes: number, nowMs: number): void {
    this.#history.add(transportSequence, bytes, nowMs);
  }

  /** @returns the result of each known packet, in sequence order */
  onFeedback(feedback: TransportFeedback, nowMs: number): PacketResult[] {
    const last = this.#lastReferenceUs ?? feedback.referenceTimeUs;
    const step = feedback.referenceTimeUs - last;
    if (step < -REFERENCE_WRAP_US / 2) this.#wrapsUs += REFERENCE_WRAP_US;
    else if (step > REFERENCE_WRAP_US / 2) this.#wrapsUs -= REFERENCE_WRAP_US;
    this.#lastReferenceUs = feedback.referenceTimeUs;

    const results: PacketResult[] = [];
    for (const { sequence, arrivalUs } of feedback.packets) {
      const sent = this.#history.take(sequence, nowMs);
      if (sent === null) {
        this.unknownPackets++;
        continue;
      }
      results.push({
        transportSequence: sequence,
        bytes: sent.bytes,
        sentMs: sent.sentMs,
        arrivalUs: arrivalUs === null ? null : arrivalUs + this.#wrapsUs,
      });
    }
    return results;
  }
}
