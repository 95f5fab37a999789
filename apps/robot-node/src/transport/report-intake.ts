/** What an operator without transport-wide feedback lets us know of its path, handed to the rate control. */

import type { RateController } from '@farpoint/congestion';
import {
  FMT_APPLICATION,
  RTCP_PAYLOAD_FEEDBACK,
  RTCP_RECEIVER_REPORT,
  RTCP_SENDER_REPORT,
  type RtcpPacket,
  readRemb,
  readReportBlocks,
} from '@farpoint/rtp';
import type { CloudTransport } from './cloud-transport.ts';

/** Who counts for itself is believed before its RTCP, for so long after it last did, ms. */
const OWN_SUMS_HOLD_MS = 3000;

/** `changed`: the rate control has learnt something. */
export type ReportOutcome = 'changed' | 'nothing-new' | 'malformed';

export class ReportIntake {
  readonly #transport: CloudTransport;
  readonly #controller: RateController;
  /** The receiver's limits: the operator's own, and its stack's. */
  #ownLimit = Number.POSITIVE_INFINITY;
  #remb = Number.POSITIVE_INFINITY;
  #ownSumsMs = Number.NEGATIVE_INFINITY;
  /** Of the latest RTCP report, for the operator's own sums, which have none; used once. */
  #rttMs: number | null = null;
  #rttHeardMs = Number.NEGATIVE_INFINITY;

  constructor(transport: CloudTransport, controller: RateController) {
    this.#transport = transport;
    this.#controller = controller;
  }

  /** The operator's own sums, from a message of its. */
  onOwnSums(packetsReceived: number, packetsLost: number, nowMs: number): void {
    this.#ownSumsMs = nowMs;
    const rttMs = nowMs - this.#rttHeardMs < OWN_SUMS_HOLD_MS ? this.#rttMs : null;
    this.#rttHeardMs = Number.NEGATIVE_INFINITY;
    this.#controller.onReceiverReport({ packetsReceived, packetsLost, source: 'application', rttMs }, nowMs);
  }

  onOwnLimit(bitsPerSecond: number, nowMs: number): void {
    this.#ownLimit = bitsPerSecond;
    this.#controller.onReceiverLimit(Math.min(this.#ownLimit, this.#remb), nowMs);
  }

  /** Of other RTCP packets it takes no notice. Transport-wide feedback says all that reports do, and more. */
  onRtcp({ packetType, format, bytes }: RtcpPacket, nowMs: number): ReportOutcome {
    if (this.#transport.transportFeedback) return 'nothing-new';
    if (packetType === RTCP_PAYLOAD_FEEDBACK && format === FMT_APPLICATION) return this.#onRemb(bytes, nowMs);
    if (packetType !== RTCP_RECEIVER_REPORT && packetType !== RTCP_SENDER_REPORT) return 'nothing-new';
    let outcome: ReportOutcome = 'nothing-new';
    const whole = readReportBlocks(packetType, bytes, (block) => {
      const sums = this.#transport.receiverSums(block, nowMs);
      if (sums === null) return;
      if (sums.rttMs != null) {
        this.#rttMs = sums.rttMs;
        this.#rttHeardMs = nowMs;
      }
      if (nowMs - this.#ownSumsMs < OWN_SUMS_HOLD_MS) return;
      this.#controller.onReceiverReport(sums, nowMs);
      outcome = 'changed';
    });
    return whole ? outcome : 'malformed';
  }

  #onRemb(bytes: Uint8Array, nowMs: number): ReportOutcome {
    const remb = readRemb(bytes);
    if (remb === null) return 'nothing-new';
    this.#remb = remb;
    this.#controller.onReceiverLimit(Math.min(this.#ownLimit, this.#remb), nowMs);
    return 'changed';
  }
}
