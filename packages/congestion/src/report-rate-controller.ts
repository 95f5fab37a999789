import type { PacketResult } from '@farpoint/rtp';
import { BitRate, WindowedMinimum } from '@farpoint/timing';
import { PACING } from './adaptive-rate-controller.ts';
import { CLEAN_LOSS } from './fixed-rate-controller.ts';
import { LossJudge } from './loss-judge.ts';
import { BASE_WINDOW_MS } from './path-observer.ts';
import {
  emptyDecision,
  type RateController,
  type RateDecision,
  type RateSnapshot,
  type ReceiverSums,
} from './rate-controller.ts';

export interface ReportRateOptions {
  startBitsPerSecond?: number;
  minBitsPerSecond?: number;
  maxBitsPerSecond?: number;
}

/** What the controller is doing. */
export type ReportState =
  | 'reports' // follows the receiver's sums
  | 'no-reports' // no report has come yet: a rate that harms hardly any path
  | 'silent'; // reports have stopped: a trickle

// Receiver reports come once or twice a second (RFC 3550). Where a number names no other source,
// docs/congestion.md has what they give together in the simulator, with reports every 0.5–1.5 s: 97 % of
// 41 Mbit/s used with a queue of 2–8 ms, 92 % under 5 % loss. report-rate-controller.test.ts asks for less.

/** Rate without any report, bit/s; and how long the start rate may last without a report, ms. */
const BLIND_BITS_PER_SECOND = 500_000;
const BLIND_AFTER_MS = 2000;
/**
 * Silence begins after this long without a report, or after three of the usual intervals. Three or more of
 * RFC 3550 are missing then.
 */
const SILENT_AFTER_MS = 3000;
/** Reports are combined until they cover this much. */
const LEAST_MS = 200;
const LEAST_PACKETS = 20;
/** After this time fewer packets suffice, ms: a slow link has no more. */
const PATIENCE_MS = 1000;
/** Above the least round trip, ms: a queue that has to be drained, and one that does not prevent growth. */
const LONG_QUEUE_MS = 60;
const SHORT_QUEUE_MS = 30;
/** After a cut, the rate is this fraction of what arrived. */
const KEEP = 0.85;
/** Growth per second: until the path has shown its limit, after that, and near the last limit. */
const SEARCH = 1.4;
const CLIMB = 1.12;
const CREEP = 1.04;
/** Rates above this fraction of the last limit are near it. */
const NEAR = 0.9;
/** If less than this fraction of the rate is used, nothing is known about higher rates. */
const USED = 0.7;
/** Weight of the newest interval between two reports. */
const SMOOTHING = 0.2;
/** Weight of the newest change in the noise of the round trip; and the largest change that counts, ms. */
const NOISE_SMOOTHING = 0.1;
const NOISE_CLAMP_MS = 40;

/**
 * Rate control for a receiver that gives no transport-wide feedback. It uses only loss and round trip, as receiver
 * reports give them a few times a second at best. It does not bet on what it cannot see: it grows slowly, falls to what
 * arrives as soon as loss or delay rises, and sends a trickle if nothing is reported. It sends no probes.
 */
export class ReportRateController implements RateController {
  readonly #min: number;
  readonly #max: number;
  readonly #baseRtt = new WindowedMinimum(BASE_WINDOW_MS);
  readonly #judgeOfLoss = new LossJudge();
  readonly #decision = emptyDecision();
  #estimate: number;
  #state: ReportState = 'no-reports';
  /** The rate that the path last carried when it was full, bit/s; infinite before that. */
  #limit = Number.POSITIVE_INFINITY;
  /** The rate before the loss cut that is on trial. */
  #beforeTrial = 0;
  #receiverLimit = Number.POSITIVE_INFINITY;
  #firstSentMs = Number.NaN;
  #lastSentMs = Number.NaN;
  #packetBytes = 1200;
  #sums: ReceiverSums | null = null;
  #sinceMs = 0;
  #lastReportMs = Number.NaN;
  #intervalMs = 1000;
  #beforeSilence = 0;
  #loss = 0;
  #rttMs: number | null = null;
  #queueMs = 0;
  #lastChange = 0;
  #opposed = 0;
  #acked = 0;

  constructor(options: ReportRateOptions = {}) {
    this.#min = options.minBitsPerSecond ?? 150_000;
    this.#max = Math.max(options.maxBitsPerSecond ?? 200e6, this.#min);
    this.#estimate = Math.min(Math.max(options.startBitsPerSecond ?? 3e6, this.#min), this.#max);
  }

  onPacketSent(_transportSequence: number, bytes: number, nowMs: number): void {
    if (Number.isNaN(this.#firstSentMs)) this.#firstSentMs = nowMs;
    // After a pause in sending, the wait for reports starts again.
    if (nowMs - this.#lastSentMs > SILENT_AFTER_MS) this.#lastReportMs = nowMs;
    this.#lastSentMs = nowMs;
    this.#packetBytes += (bytes - this.#packetBytes) * 0.01;
  }

  /** Unused: this controller is chosen only if there is no transport-wide feedback. */
  onFeedback(_results: readonly PacketResult[], _nowMs: number): void {}

  onReceiverReport(report: ReceiverSums, nowMs: number): void {
    if (Number.isNaN(this.#firstSentMs)) return;
    const last = this.#sums;
    const restarted = last === null || report.source !== last.source;
    // Reports may arrive out of order; the sums only grow.
    if (!restarted && report.packetsReceived < last.packetsReceived) return;
    this.#noteReport(nowMs);
    if (report.rttMs != null) this.#noteRtt(report.rttMs, nowMs);
    if (restarted) {
      this.#sums = { ...report };
      this.#sinceMs = nowMs;
      return;
    }
    const received = report.packetsReceived - last.packetsReceived;
    // A packet that arrives late cancels a loss.
    const lost = Math.max(report.packetsLost - last.packetsLost, 0);
    const sinceMs = this.#sinceMs;
    if (nowMs - sinceMs < LEAST_MS) return;
    if (received + lost < LEAST_PACKETS && nowMs - sinceMs < PATIENCE_MS) return;
    this.#sums = { ...report };
    this.#sinceMs = nowMs;
    if (received + lost > 0) this.#judge(received, lost, sinceMs, nowMs);
  }

  onReceiverLimit(bitsPerSecond: number, _nowMs: number): void {
    this.#receiverLimit = Math.max(bitsPerSecond, 0);
  }

  update(nowMs: number): void {
    if (Number.isNaN(this.#firstSentMs) || this.#state === 'silent') return;
    if (this.#state === 'no-reports') {
      if (nowMs - this.#firstSentMs > BLIND_AFTER_MS) {
        this.#estimate = Math.min(this.#estimate, Math.max(BLIND_BITS_PER_SECOND, this.#min));
      }
      return;
    }
    const patienceMs = Math.max(SILENT_AFTER_MS, 3 * this.#intervalMs);
    if (nowMs - this.#lastReportMs <= patienceMs || this.#lastSentMs <= this.#lastReportMs) return;
    this.#state = 'silent';
    this.#beforeSilence = this.#estimate;
    this.#estimate = this.#min;
  }

  targetBitsPerSecond(_nowMs: number): number {
    return Math.min(this.#estimate, this.#receiverLimit);
  }

  /** No window, because the bytes in flight are unknown. No probes. */
  decision(nowMs: number): Readonly<RateDecision> {
    this.#decision.targetBitsPerSecond = this.targetBitsPerSecond(nowMs);
    this.#decision.pacingBitsPerSecond = this.#decision.targetBitsPerSecond * PACING;
    return this.#decision;
  }

  snapshot(_nowMs: number): RateSnapshot {
    return {
      estimateBitsPerSecond: this.#estimate,
      state: this.#state,
      lossFraction: this.#loss,
      rttMs: this.#rttMs,
      queueMs: this.#queueMs,
      ackedBitsPerSecond: this.#acked,
    };
  }

  #noteReport(nowMs: number): void {
    if (this.#state === 'reports') {
      this.#intervalMs += (nowMs - this.#lastReportMs - this.#intervalMs) * SMOOTHING;
    } else {
      // What was sent during the silence says nothing about the present path.
      if (this.#state === 'silent') this.#estimate = Math.max(this.#beforeSilence / 2, this.#min);
      this.#state = 'reports';
      this.#sums = null;
    }
    this.#lastReportMs = nowMs;
  }

  #noteRtt(rttMs: number, nowMs: number): void {
    this.#rttMs = rttMs;
    this.#baseRtt.add(rttMs, nowMs);
    const queueMs = Math.max(rttMs - this.#baseRtt.value, 0);
    // Each sample comes from a single packet. Jitter shows as changes followed by opposite ones.
    const change = Math.min(Math.max(queueMs - this.#queueMs, -NOISE_CLAMP_MS), NOISE_CLAMP_MS);
    this.#opposed += (-change * this.#lastChange - this.#opposed) * NOISE_SMOOTHING;
    this.#lastChange = change;
    this.#queueMs = queueMs;
  }

  #judge(received: number, lost: number, sinceMs: number, nowMs: number): void {
    const elapsedMs = nowMs - sinceMs;
    this.#loss = lost / (received + lost);
    this.#acked = BitRate.of(received * this.#packetBytes, elapsedMs);
    const verdict = this.#judgeOfLoss.onFeedback(received, lost, sinceMs - (this.#rttMs ?? 0), nowMs);
    // The rate that had to be sent for this much to arrive, on a link that always loses some.
    const through = this.#acked / (1 - this.#judgeOfLoss.base);
    if (this.#queueMs > LONG_QUEUE_MS + 3 * this.#noiseMs) {
      this.#limit = Math.min(this.#estimate, through);
      this.#estimate = this.#limit * KEEP;
    } else if (verdict === 'excess') {
      this.#beforeTrial = this.#estimate;
      this.#limit = Math.min(this.#estimate, this.#acked);
      this.#estimate = this.#limit * KEEP;
      this.#judgeOfLoss.cutAt(nowMs);
    } else if (verdict === 'innocent') {
      this.#estimate = Math.max(this.#estimate, this.#beforeTrial);
      this.#limit = Number.POSITIVE_INFINITY;
    } else if (through > USED * this.targetBitsPerSecond(nowMs) && this.#mayGrow) {
      this.#estimate *= this.#growth ** Math.min(elapsedMs / 1000, 1);
    }
    this.#estimate = Math.min(Math.max(this.#estimate, this.#min), this.#max);
  }

  get #noiseMs(): number {
    return Math.sqrt(Math.max(this.#opposed, 0));
  }

  /** Growth factor per second. */
  get #growth(): number {
    if (this.#limit === Number.POSITIVE_INFINITY) return SEARCH;
    if (this.#estimate < NEAR * this.#limit) return CLIMB;
    // A rate well above the old limit means that the path has changed.
    if (this.#estimate > this.#limit / NEAR) this.#limit = Number.POSITIVE_INFINITY;
    return CREEP;
  }

  /** While the delay is unknown, growth needs a path without loss. */
  get #mayGrow(): boolean {
    if (this.#judgeOfLoss.onTrial) return false;
    return this.#rttMs === null ? this.#loss < CLEAN_LOSS : this.#queueMs < SHORT_QUEUE_MS + this.#noiseMs;
  }
}
