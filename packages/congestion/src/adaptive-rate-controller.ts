import type { PacketResult } from '@farpoint/rtp';
import { BitRate } from '@farpoint/timing';
import { Competition } from './competition.ts';
import { DelayLaw, growth, noiseAllowanceMs, toleratedQueueMs } from './delay-law.ts';
import { FramePace } from './frame-pace.ts';
import { InFlight } from './in-flight.ts';
import { LossJudge } from './loss-judge.ts';
import { PathObserver } from './path-observer.ts';
import { ProbePlan } from './probe-plan.ts';
import { ProbeTester } from './probe-tester.ts';
import {
  emptyDecision,
  type RateController,
  type RateDecision,
  type RateSnapshot,
  type ReceiverSums,
} from './rate-controller.ts';
import { Silence } from './silence.ts';

export interface AdaptiveRateOptions {
  /** Rate to start at, while nothing is known of the path, bit/s. */
  startBitsPerSecond?: number;
  /** Lower bound of the estimate, bit/s. */
  minBitsPerSecond?: number;
  /** The most the sources could use, bit/s. */
  maxBitsPerSecond?: number;
}

/** What the controller is doing. */
export type AdaptiveState =
  | 'steady' // grows slowly, probes from time to time
  | 'drain' // the queue is too long and is being drained
  | 'compete' // a competitor keeps the queue full: takes the share that TCP would
  | 'silent'; // no feedback: sends a trickle

// The numbers of this controller and of its parts work together: delay-law.ts, probe-plan.ts, loss-judge.ts
// and so on. Where none of them names a source, `pnpm bench congestion` measures what they give, and
// adaptive-rate-controller.test.ts and the cases of RFC 8867 (testing/rfc8867.test.ts) hold it.

/** Of the rate that the path carries: a frame has been sent before the next one comes. */
export const PACING = 1.1;
/**
 * The estimate may rise to this multiple of what the sources use: a frame that is sent faster is shown
 * sooner. `pnpm bench bridge --profile`, 7,500 points: at the page's socket after 5.3 ms instead of 25.6.
 */
const PACE_HEADROOM = 2;
const LEAST_PACING = 300_000;
/** As many bytes as the shortest train of a probe has (probe-plan.ts). */
const LEAST_WINDOW_BYTES = 7500;
/** Below this rate, the source cannot follow in fine steps, so the rate it leaves unused means nothing, bit/s. */
const SMALL = 1e6;
/** If a queue has been drained for this long and the delay still has a floor, there is no queue, ms. */
const STUCK_MS = 400;
/** The fraction of the arriving rate that is kept after excess loss; and the largest cut in one step. */
const KEEP_IN_LOSS = 0.95;
const LOSS_CUT = 0.85;

/**
 * Finds the rate that a path carries with little queueing. Its inputs are the one-way delay, arrival rate and loss from
 * transport-wide feedback, and probe trains sent at a higher rate. See docs/congestion.md. Needs transport-wide
 * feedback; without it, the controller stays silent.
 */
export class AdaptiveRateController implements RateController {
  readonly #min: number;
  /** Upper bound of the target rate. The estimate may exceed it, up to `#max`, because frames may be paced faster. */
  readonly #most: number;
  readonly #max: number;
  readonly #frame: FramePace;
  /** The train on its way is for the pace of a frame, not for the estimate. */
  #probesPace = false;
  readonly #path = new PathObserver();
  readonly #flight = new InFlight();
  readonly #delay = new DelayLaw();
  readonly #loss = new LossJudge();
  readonly #probe = new ProbeTester();
  readonly #plan = new ProbePlan();
  readonly #competition = new Competition();
  readonly #silence = new Silence();
  #estimate: number;
  /** When draining began. */
  #drainSinceMs = 0;
  #state: AdaptiveState = 'steady';
  /** The fraction of the estimate that is held back for now. */
  #heldBack = 0;
  #receiverLimit = Number.POSITIVE_INFINITY;
  #lastFeedbackMs = Number.NaN;
  #lastOveruseMs = Number.NEGATIVE_INFINITY;
  /** Losses of packets sent before this time say nothing about the present path. */
  #ignoreLossBeforeMs = Number.NEGATIVE_INFINITY;
  /** The rate before the loss cut that is on trial; 0 if delay has cut the rate since. */
  #beforeTrial = 0;
  readonly #decision = emptyDecision();

  constructor(options: AdaptiveRateOptions = {}) {
    this.#min = options.minBitsPerSecond ?? 150_000;
    this.#most = Math.max(options.maxBitsPerSecond ?? 200e6, this.#min);
    this.#max = PACE_HEADROOM * this.#most;
    this.#frame = new FramePace(this.#most);
    this.#estimate = Math.min(Math.max(options.startBitsPerSecond ?? 3e6, this.#min), this.#most);
  }

  onPacketSent(transportSequence: number, bytes: number, nowMs: number, probeCluster = 0): void {
    // After a pause in sending, the wait for feedback starts again.
    if (this.#flight.bytes === 0) this.#lastFeedbackMs = nowMs;
    this.#flight.onSent(transportSequence, bytes, probeCluster);
    if (probeCluster !== 0) this.#probe.onSent(bytes, probeCluster, nowMs);
  }

  onFeedback(results: readonly PacketResult[], nowMs: number): void {
    const newest = results[results.length - 1];
    if (newest === undefined || Number.isNaN(this.#lastFeedbackMs)) return;
    const elapsedMs = Math.min(Math.max(nowMs - this.#lastFeedbackMs, 0), 200);
    this.#lastFeedbackMs = nowMs;
    this.#flight.onAnswered(newest.transportSequence);
    if (this.#state === 'silent') this.#resume(nowMs);
    const arrived = this.#path.onFeedback(results, nowMs);
    if (arrived) this.#onDelay(elapsedMs, nowMs);
    if (this.#state !== 'compete') this.#onLoss(nowMs);
    if (arrived) this.#onProbe(results, nowMs);
    this.#estimate = Math.min(Math.max(this.#estimate, this.#min), this.#max);
  }

  /** Ignored: transport-wide feedback says more. */
  onReceiverReport(_report: ReceiverSums, _nowMs: number): void {}

  onReceiverLimit(bitsPerSecond: number, _nowMs: number): void {
    this.#receiverLimit = Math.max(bitsPerSecond, 0);
  }

  update(nowMs: number): void {
    const { feedbackIntervalMs, baseRttMs } = this.#path;
    const unsent = this.#probe.expire(nowMs, baseRttMs);
    if (unsent && this.#probesPace) this.#frame.onUnsent(nowMs);
    else if (unsent) this.#plan.onIgnored();
    if (this.#state !== 'silent') {
      const sinceMs = nowMs - this.#lastFeedbackMs;
      if (!Silence.begins(this.#flight.bytes, sinceMs, feedbackIntervalMs, baseRttMs)) {
        this.#wishProbe(nowMs);
        return;
      }
      this.#state = 'silent';
      this.#silence.begin(this.#lastFeedbackMs);
      this.#frame.onFull(nowMs);
      this.#probe.cancel();
    }
    this.#silence.trickle(this.#flight.bytes, nowMs);
  }

  targetBitsPerSecond(_nowMs: number): number {
    return Math.min(this.#receiverLimit, this.#most, this.#pathBitsPerSecond);
  }

  /** The rate that the path may be given now, regardless of the receiver's limit. */
  get #pathBitsPerSecond(): number {
    const rate = this.#state === 'silent' ? this.#min : this.#estimate * (1 - this.#heldBack);
    return Math.max(rate, this.#min);
  }

  decision(nowMs: number): Readonly<RateDecision> {
    const d = this.#decision;
    d.targetBitsPerSecond = this.targetBitsPerSecond(nowMs);
    // The receiver's limit bounds the total rate. The pace of a frame depends on the path alone.
    const estimatePace = this.#pathBitsPerSecond * PACING;
    d.pacingBitsPerSecond = Math.max(estimatePace, this.#frame.bitsPerSecond, LEAST_PACING);
    d.bytesInFlight = this.#flight.bytes;
    d.congestionWindowBytes = this.#windowBytes();
    d.probe = this.#state === 'silent' ? null : this.#probe.wish;
    return d;
  }

  snapshot(_nowMs: number): RateSnapshot {
    const o = this.#path.observation;
    return {
      estimateBitsPerSecond: this.#estimate,
      state: this.#state === 'steady' && this.#plan.searching ? 'search' : this.#state,
      lossFraction: this.#loss.fraction,
      rttMs: o.rttMs > 0 ? o.rttMs : null,
      queueMs: o.queueMs,
      ackedBitsPerSecond: o.ackedBitsPerSecond,
    };
  }

  #windowBytes(): number {
    if (this.#state === 'silent') return this.#silence.windowBytes;
    const { baseRttMs, feedbackIntervalMs } = this.#path;
    // Just before feedback arrives, one round trip plus one feedback interval is in flight. One feedback message may be
    // missing without stopping the sender, except while a queue is being drained.
    const missedMs = this.#state === 'drain' ? 0 : feedbackIntervalMs + 15;
    const rate = this.#estimate * (1 - (this.#state === 'drain' ? this.#heldBack : 0));
    const bytes = BitRate.bytesIn(rate, baseRttMs + feedbackIntervalMs + 5 + missedMs);
    if (this.#state === 'compete') return this.#competition.windowBytes + bytes;
    // A probe train must fit in beside what is already in flight.
    return Math.max(bytes, LEAST_WINDOW_BYTES) + (this.#probe.wish?.bytes ?? 0);
  }

  #onDelay(elapsedMs: number, nowMs: number): void {
    const { observation: o, noiseMs, baseRttMs } = this.#path;
    const allowanceMs = noiseAllowanceMs(noiseMs);
    const toleratedMs = toleratedQueueMs(this.#estimate) + allowanceMs;
    if (this.#state !== 'drain') this.#drainSinceMs = nowMs;
    else if (nowMs - this.#drainSinceMs > STUCK_MS && this.#path.settledQueueMs > toleratedMs / 2) {
      // The delay does not fall however little is sent: the path has become longer and there is no queue.
      this.#path.lengthen(nowMs);
      this.#state = 'steady';
      this.#heldBack = 0;
      return;
    }
    if (this.#state !== 'compete') {
      if (this.#competition.notice(o, this.#estimate, this.#heldBack, allowanceMs, elapsedMs)) {
        this.#state = 'compete';
        this.#plan.onOveruse(1);
        this.#probe.cancel();
        this.#competition.begin(o, this.#estimate, baseRttMs, nowMs);
      }
    }
    if (this.#state === 'compete') {
      const expected = (o.received + o.lost) * this.#loss.base;
      const congested = o.lost > expected + 3 * Math.sqrt(expected);
      const rate = this.#competition.update(o, congested, baseRttMs, toleratedMs, elapsedMs, nowMs);
      if (rate === null) this.#state = 'drain';
      else this.#estimate = rate;
      this.#heldBack = this.#competition.heldBack(nowMs);
      return;
    }
    const reading = this.#delay.read(o, toleratedMs, allowanceMs, noiseMs);
    this.#frame.onMessage(reading === 'over', nowMs);
    if (reading === 'over') {
      const before = this.#estimate;
      this.#estimate = this.#delay.estimateWhenOver(this.#path, before, toleratedMs);
      this.#state = 'drain';
      // A train that ends because of its own queue has found no higher rate either.
      if (this.#probe.busy) this.#plan.onCut(nowMs);
      this.#probe.cancel();
      if (this.#estimate < before) {
        this.#beforeTrial = 0;
        this.#onOveruse(this.#estimate / before, nowMs);
      }
    } else if (this.#state === 'drain') {
      if (reading === 'clear') this.#state = 'steady';
    } else if (
      (this.#used() > 0.75 || this.#estimate < SMALL) &&
      (!this.#plan.searching || this.#plan.ignored)
    ) {
      // Without probes, the search doubles the rate every 0.7 s.
      const perSecond = this.#plan.searching ? this.#estimate : growth(this.#estimate);
      this.#estimate += (perSecond * elapsedMs) / 1000;
    }
    this.#heldBack = this.#state === 'drain' ? this.#delay.drain(o, allowanceMs) : 0;
  }

  /** The fraction of the estimate that the source uses. */
  #used(): number {
    return this.#path.observation.ackedBitsPerSecond / (this.#estimate * (1 - this.#loss.base));
  }

  #onOveruse(kept: number, nowMs: number): void {
    this.#lastOveruseMs = nowMs;
    this.#plan.onOveruse(kept);
    this.#probe.cancel();
  }

  #onLoss(nowMs: number): void {
    const o = this.#path.observation;
    if (o.oldestSentMs < this.#ignoreLossBeforeMs) return;
    const verdict = this.#loss.onFeedback(o.received, o.lost, o.oldestSentMs, nowMs);
    if (verdict === 'excess') {
      this.#beforeTrial = this.#estimate;
      const through = (KEEP_IN_LOSS * o.ackedBitsPerSecond) / (1 - this.#loss.base);
      this.#estimate = Math.min(this.#estimate, Math.max(through, LOSS_CUT * this.#estimate));
      this.#loss.cutAt(nowMs);
      this.#frame.onFull(nowMs);
      this.#onOveruse(1, nowMs);
    } else if (verdict === 'innocent') {
      this.#estimate = Math.max(this.#estimate, this.#beforeTrial);
    }
  }

  #onProbe(results: readonly PacketResult[], nowMs: number): void {
    const outcome = this.#probe.onFeedback(results, this.#flight);
    if (outcome === null || this.#state !== 'steady') return;
    if (this.#probesPace) this.#frame.onOutcome(outcome, nowMs);
    else this.#estimate = this.#plan.onOutcome(outcome, this.#estimate, this.#path.noiseMs, nowMs);
  }

  #wishProbe(nowMs: number): void {
    if (this.#state !== 'steady' || this.#probe.busy || this.#loss.onTrial) return;
    this.#probesPace = this.#estimate >= this.#max;
    const rate = this.#probesPace ? this.#frame.trainRate(this.#estimate, nowMs) : this.#plannedRate(nowMs);
    if (rate === null) return;
    this.#probe.ask(rate, this.#plan.bytes(Math.min(rate, this.#max), this.#path.noiseMs), nowMs);
    if (!this.#probesPace) this.#plan.onAsked(nowMs);
  }

  #plannedRate(nowMs: number): number | null {
    const due = this.#plan.isDue(nowMs - this.#lastOveruseMs, this.#used() < 0.5, nowMs);
    return due ? this.#plan.rate(this.#estimate, this.#max) : null;
  }

  /** Restarts when feedback returns after a silence. */
  #resume(nowMs: number): void {
    this.#estimate = this.#silence.rateAfter(this.#estimate, nowMs);
    this.#state = 'steady';
    this.#path.forgetRates();
    this.#plan.restart();
    this.#ignoreLossBeforeMs = nowMs;
    this.#loss.forget();
    this.#heldBack = 0;
  }
}
