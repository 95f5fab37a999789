import {
  emptyDecision,
  InFlight,
  ProbeTester,
  type RateController,
  type RateDecision,
  type RateSnapshot,
  type ReceiverSums,
} from '@farpoint/congestion';
import type { PacketResult } from '@farpoint/rtp';
import { AimdRate } from './aimd-rate.ts';
import { IncomingRate } from './incoming-rate.ts';
import { LossController } from './loss-controller.ts';
import { OveruseDetector } from './overuse-detector.ts';
import { PacketGroups } from './packet-groups.ts';
import { StartProbes } from './start-probes.ts';
import { Trendline } from './trendline.ts';

export interface GccOptions {
  startBitsPerSecond?: number;
  minBitsPerSecond?: number;
  maxBitsPerSecond?: number;
}

/** The same factor as the point pacer's; libwebrtc's 2.5 would send whole frames in bursts. */
const PACING = 1.1;
/** After this long without feedback, delay measurement restarts, ms. */
const STALE_MS = 2000;
const FIRST_ROUND_TRIP_MS = 200;

/**
 * Google congestion control, written from draft-ietf-rmcat-gcc-02, with libwebrtc's trend line instead of the Kalman
 * filter. AdaptiveRateController is compared with it. Delay and loss each give a rate; the lower one counts (section
 * 6).
 */
export class GccController implements RateController {
  readonly #most: number;
  readonly #flight = new InFlight();
  readonly #groups = new PacketGroups();
  #trendline = new Trendline();
  #detector = new OveruseDetector();
  readonly #incoming = new IncomingRate();
  readonly #rate: AimdRate;
  readonly #loss: LossController;
  readonly #search: StartProbes;
  readonly #probe = new ProbeTester();
  #roundTripMs = Number.NaN;
  #feedbackMs = Number.NaN;
  #receiverLimit = Number.POSITIVE_INFINITY;
  readonly #decision = emptyDecision();

  constructor(options: GccOptions = {}) {
    const start = options.startBitsPerSecond ?? 3e6;
    const least = options.minBitsPerSecond ?? 150_000;
    this.#most = options.maxBitsPerSecond ?? 200e6;
    this.#rate = new AimdRate(start, least, this.#most);
    this.#loss = new LossController(start, least);
    this.#search = new StartProbes(start);
  }

  onPacketSent(transportSequence: number, bytes: number, nowMs: number, probeCluster = 0): void {
    this.#flight.onSent(transportSequence, bytes, probeCluster);
    this.#probe.onSent(bytes, probeCluster, nowMs);
  }

  onFeedback(results: readonly PacketResult[], nowMs: number): void {
    const newest = results[results.length - 1];
    if (newest === undefined) return;
    if (nowMs - this.#feedbackMs > STALE_MS) this.#forget();
    this.#feedbackMs = nowMs;
    this.#flight.onAnswered(newest.transportSequence);
    let lost = 0;
    for (const { bytes, sentMs, arrivalUs } of results) {
      if (arrivalUs === null) {
        lost++;
        continue;
      }
      this.#roundTripMs = nowMs - sentMs;
      this.#incoming.add(bytes, sentMs, arrivalUs / 1000);
      this.#onArrival(sentMs, arrivalUs / 1000);
    }
    if (lost < results.length) this.#onDelay(results, nowMs);
    this.#loss.onReport(results.length, lost, this.#rate.estimate);
  }

  /** Ignored, because transport-wide feedback says more. */
  onReceiverReport(_report: ReceiverSums, _nowMs: number): void {}

  onReceiverLimit(bitsPerSecond: number, _nowMs: number): void {
    this.#receiverLimit = Math.max(bitsPerSecond, 0);
  }

  update(nowMs: number): void {
    this.#probe.expire(nowMs, this.#roundTrip);
    if (this.#probe.busy) return;
    const rate = this.#search.due(this.#most, nowMs);
    if (rate > 0) this.#probe.ask(rate, StartProbes.bytes(rate), nowMs);
  }

  targetBitsPerSecond(_nowMs: number): number {
    return Math.min(this.#loss.estimate, this.#receiverLimit);
  }

  decision(nowMs: number): Readonly<RateDecision> {
    const d = this.#decision;
    d.targetBitsPerSecond = this.targetBitsPerSecond(nowMs);
    d.pacingBitsPerSecond = PACING * this.#loss.estimate;
    d.bytesInFlight = this.#flight.bytes;
    d.probe = this.#probe.wish;
    return d;
  }

  snapshot(_nowMs: number): RateSnapshot {
    const incoming = this.#incoming.bitsPerSecond;
    return {
      estimateBitsPerSecond: this.#loss.estimate,
      state: this.#rate.state,
      lossFraction: this.#loss.fraction,
      rttMs: Number.isNaN(this.#roundTripMs) ? null : this.#roundTripMs,
      queueMs: 0,
      ackedBitsPerSecond: Number.isNaN(incoming) ? 0 : incoming,
    };
  }

  get #roundTrip(): number {
    return Number.isNaN(this.#roundTripMs) ? FIRST_ROUND_TRIP_MS : this.#roundTripMs;
  }

  #onArrival(sentMs: number, arrivalMs: number): void {
    const groups = this.#groups;
    if (!groups.add(sentMs, arrivalMs)) return;
    const slope = this.#trendline.add(groups.sentDeltaMs, groups.arrivalDeltaMs, groups.arrivedMs);
    this.#detector.update(slope, this.#trendline.count, groups.sentDeltaMs, groups.arrivedMs);
  }

  #onDelay(results: readonly PacketResult[], nowMs: number): void {
    const outcome = this.#probe.onFeedback(results, this.#flight);
    const { usage } = this.#detector;
    if (outcome !== null && usage !== 'over') {
      const found = this.#search.onOutcome(outcome.sentBitsPerSecond, outcome.arrivedBitsPerSecond);
      this.#rate.set(found, nowMs);
      this.#loss.raise(found);
    } else {
      this.#rate.update(usage, this.#incoming.bitsPerSecond, this.#roundTrip, nowMs);
    }
  }

  /** Forgets earlier measurements, which are meaningless after a long silence. */
  #forget(): void {
    this.#groups.reset();
    this.#trendline = new Trendline();
    this.#detector = new OveruseDetector();
    this.#incoming.reset();
  }
}
