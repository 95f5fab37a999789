/** Passes on to the rate controller what an operator without transport-wide feedback reports about its path. */

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
import type { RtpTransport } from './rtp-transport.ts';

/**
 * An operator's own counts take precedence over its RTCP for this long after the last of them, ms. After as
 * long without reports, ReportRateController calls them missing.
 */
const OWN_SUMS_HOLD_MS = 3000;

/** `changed`: the rate controller got new information. */
export type ReportOutcome = 'changed' | 'nothing-new' | 'malformed';

export class ReportIntake {
  readonly #transport: RtpTransport;
  readonly #controller: RateController;
  /** The receiver's limits: one from the operator itself, one from its WebRTC stack. */
  #ownLimit = Number.POSITIVE_INFINITY;
  #remb = Number.POSITIVE_INFINITY;
  #ownSumsMs = Number.NEGATIVE_INFINITY;
  /** Round trip from the latest RTCP report, for the operator's own counts, which have none. Used once. */
  #rttMs: number | null = null;
  #rttHeardMs = Number.NEGATIVE_INFINITY;

  constructor(transport: RtpTransport, controller: RateController) {
    this.#transport = transport;
    this.#controller = controller;
  }

  /** Takes the operator's own counts, from one of its messages. */
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

  /** Ignores other RTCP packets. Transport-wide feedback says everything that reports say, and more. */
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
