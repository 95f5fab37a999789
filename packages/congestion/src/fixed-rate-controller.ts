import type { PacketResult } from '@farpoint/rtp';
import {
  emptyDecision,
  type RateController,
  type RateDecision,
  type RateSnapshot,
  type ReceiverSums,
} from './rate-controller.ts';

export interface FixedRateOptions {
  /** The configured rate, bit/s: the start value and the maximum. */
  bitsPerSecond: number;
  /** Loss never lowers the rate below this, bit/s. A receiver's limit may. */
  floorBitsPerSecond?: number;
  /** Loss above this fraction for a whole interval halves the rate. */
  lossThreshold?: number;
  /** How long loss, or its absence, must last, ms. */
  intervalMs?: number;
  /** Factor by which the rate rises after an interval with (nearly) no loss. */
  increase?: number;
}

/**
 * Loss below this fraction counts as none: radio links lose a little without being full. As in
 * draft-ietf-rmcat-gcc-02, 6.
 */
export const CLEAN_LOSS = 0.02;
/** With fewer packets than this, a loss fraction means nothing. */
const MIN_PACKETS = 20;

/**
 * Sends at the configured rate. Sustained loss halves the rate; intervals without loss raise it again. The controller
 * does not look at queues: it fills a link with a long queue until packets are lost.
 *
 * Each interval is judged by itself. Transport-wide feedback takes precedence over the receiver's sums. If a receiver
 * has answered before and answers nothing for a whole interval in which packets were sent, everything counts as lost.
 */
export class FixedRateController implements RateController {
  readonly #configured: number;
  readonly #floor: number;
  readonly #lossThreshold: number;
  readonly #intervalMs: number;
  readonly #increase: number;
  #rate: number;
  #receiverLimit = Number.POSITIVE_INFINITY;
  #intervalStartMs: number | null = null;
  #packetsSent = 0;
  #answered = false;
  #feedback = { received: 0, lost: 0 };
  #sums: ReceiverSums | null = null;
  #sumsAtStart: ReceiverSums | null = null;
  #reportInInterval = false;
  #loss = 0;
  readonly #decision = emptyDecision();

  constructor(options: FixedRateOptions) {
    this.#configured = options.bitsPerSecond;
    this.#floor = Math.min(options.floorBitsPerSecond ?? 1_000_000, this.#configured);
    this.#lossThreshold = options.lossThreshold ?? 0.1;
    this.#intervalMs = options.intervalMs ?? 1000;
    this.#increase = options.increase ?? 1.2;
    this.#rate = this.#configured;
  }

  onPacketSent(_transportSequence: number, _bytes: number, nowMs: number): void {
    this.#intervalStartMs ??= nowMs;
    this.#packetsSent++;
  }

  onFeedback(results: readonly PacketResult[], nowMs: number): void {
    for (const { arrivalUs } of results) {
      if (arrivalUs === null) this.#feedback.lost++;
      else this.#feedback.received++;
    }
    this.update(nowMs);
  }

  onReceiverReport(report: ReceiverSums, nowMs: number): void {
    const last = this.#sums;
    // Reports may arrive out of order; the sums only grow.
    if (last !== null && report.packetsReceived < last.packetsReceived) return;
    this.#sums = { packetsReceived: report.packetsReceived, packetsLost: report.packetsLost };
    this.#sumsAtStart ??= this.#sums;
    this.#reportInInterval = true;
    this.update(nowMs);
  }

  onReceiverLimit(bitsPerSecond: number, _nowMs: number): void {
    this.#receiverLimit = Math.max(bitsPerSecond, 0);
  }

  update(nowMs: number): void {
    if (this.#intervalStartMs === null || nowMs - this.#intervalStartMs < this.#intervalMs) return;
    const loss = this.#lossFraction();
    if (loss !== null) {
      this.#loss = loss;
      if (loss > this.#lossThreshold) this.#rate = Math.max(this.#rate / 2, this.#floor);
      else if (loss < CLEAN_LOSS) this.#rate = Math.min(this.#rate * this.#increase, this.#configured);
    }
    this.#intervalStartMs = nowMs;
    this.#packetsSent = 0;
    this.#feedback = { received: 0, lost: 0 };
    this.#sumsAtStart = this.#sums;
    this.#reportInInterval = false;
  }

  targetBitsPerSecond(_nowMs: number): number {
    return Math.min(this.#rate, this.#receiverLimit);
  }

  /** Without a congestion window and without probes. */
  decision(nowMs: number): Readonly<RateDecision> {
    this.#decision.targetBitsPerSecond = this.targetBitsPerSecond(nowMs);
    this.#decision.pacingBitsPerSecond = this.#decision.targetBitsPerSecond * 1.1;
    return this.#decision;
  }

  snapshot(nowMs: number): RateSnapshot {
    return {
      estimateBitsPerSecond: this.targetBitsPerSecond(nowMs),
      state: 'fixed',
      lossFraction: this.#loss,
      rttMs: null,
      queueMs: 0,
      ackedBitsPerSecond: 0,
    };
  }

  /** Loss fraction of this interval; `null` if unknown. */
  #lossFraction(): number | null {
    const { received, lost } = this.#feedback;
    const heard = received + lost > 0 || this.#reportInInterval;
    if (heard) this.#answered = true;
    else return this.#answered && this.#packetsSent >= MIN_PACKETS ? 1 : null;
    if (received + lost >= MIN_PACKETS) return lost / (received + lost);
    if (this.#sums === null || this.#sumsAtStart === null) return null;
    const sumReceived = this.#sums.packetsReceived - this.#sumsAtStart.packetsReceived;
    // A packet that arrives late cancels a loss.
    const sumLost = Math.max(this.#sums.packetsLost - this.#sumsAtStart.packetsLost, 0);
    return sumReceived + sumLost >= MIN_PACKETS ? sumLost / (sumReceived + sumLost) : null;
  }
}
