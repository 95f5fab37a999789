import type { PacketResult } from '@farpoint/rtp';
import { BitRate } from '@farpoint/timing';
import { Competition } from './competition.ts';
import { DelayLaw, growth, noiseAllowanceMs, toleratedQueueMs } from './delay-law.ts';
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
  /** Before anything is known of the path, bit/s. */
  startBitsPerSecond?: number;
  /** The estimate never falls below, bit/s. */
  minBitsPerSecond?: number;
  /** What the sources could use at the most, bit/s. */
  maxBitsPerSecond?: number;
}

/** What the controller is doing. */
export type AdaptiveState =
  | 'steady' // grows slowly, probes now and then
  | 'drain' // the queue is too long and being emptied
  | 'compete' // somebody else keeps the queue full: shares as TCP would
  | 'silent'; // no feedback: a trickle

const PACING = 1.1;
/** The path is looked into up to so many times what the sources use: a frame that goes faster is shown sooner. */
const PACE_HEADROOM = 2;
const LEAST_PACING = 300_000;
const LEAST_WINDOW_BYTES = 7500;
/** Below this the source cannot follow the rate in fine steps: what it leaves unused says nothing, bit/s. */
const SMALL = 1e6;
/** A queue that is being emptied for so long and has a floor is none, ms. */
const STUCK_MS = 400;
/** Of what arrives under too much loss, the part that is kept; and the most that is given up at once. */
const KEEP_IN_LOSS = 0.95;
const LOSS_CUT = 0.85;

/**
 * Finds the rate that a path carries with little waiting in its queue: from one-way delay, arrival rate and loss as
 * transport-wide feedback tells them, and from trains at a higher rate. docs/congestion.md explains it. Needs transport-wide
 * feedback: without any it stays silent.
 */
export class AdaptiveRateController implements RateController {
  readonly #min: number;
  /** What may be sent, and what is found out of the path beyond it: how fast a frame may go. */
  readonly #most: number;
  readonly #max: number;
  readonly #path = new PathObserver();
  readonly #flight = new InFlight();
  readonly #delay = new DelayLaw();
  readonly #loss = new LossJudge();
  readonly #probe = new ProbeTester();
  readonly #plan = new ProbePlan();
  readonly #competition = new Competition();
  readonly #silence = new Silence();
  #estimate: number;
  /** Since when the queue is being emptied. */
  #drainSinceMs = 0;
  #state: AdaptiveState = 'steady';
  /** The part of the estimate that is held back for now. */
  #heldBack = 0;
  #receiverLimit = Number.POSITIVE_INFINITY;
  #lastFeedbackMs = Number.NaN;
  #lastOveruseMs = Number.NEGATIVE_INFINITY;
  /** Loss of packets that left before this time tells nothing of the present path. */
  #ignoreLossBeforeMs = Number.NEGATIVE_INFINITY;
  /** The rate before the cut for loss that is on trial; 0 where delay has cut it since. */
  #beforeTrial = 0;
  readonly #decision = emptyDecision();

  constructor(options: AdaptiveRateOptions = {}) {
    this.#min = options.minBitsPerSecond ?? 150_000;
    this.#most = Math.max(options.maxBitsPerSecond ?? 200e6, this.#min);
    this.#max = PACE_HEADROOM * this.#most;
    this.#estimate = Math.min(Math.max(options.startBitsPerSecond ?? 3e6, this.#min), this.#most);
  }

  onPacketSent(transportSequence: number, bytes: number, nowMs: number, probeCluster = 0): void {
    // After a pause the wait for feedback begins anew.
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

  /** Transport-wide feedback says more. */
  onReceiverReport(_report: ReceiverSums, _nowMs: number): void {}

  onReceiverLimit(bitsPerSecond: number, _nowMs: number): void {
    this.#receiverLimit = Math.max(bitsPerSecond, 0);
  }

  onTick(nowMs: number): void {
    const { feedbackIntervalMs, baseRttMs } = this.#path;
    if (this.#probe.onTick(nowMs, baseRttMs)) this.#plan.onIgnored();
    if (this.#state !== 'silent') {
      const sinceMs = nowMs - this.#lastFeedbackMs;
      if (!Silence.begins(this.#flight.bytes, sinceMs, feedbackIntervalMs, baseRttMs)) {
        this.#wishProbe(nowMs);
        return;
      }
      this.#state = 'silent';
      this.#silence.begin(this.#lastFeedbackMs);
      this.#probe.cancel();
    }
    this.#silence.onTick(this.#flight.bytes, nowMs);
  }

  targetBitsPerSecond(_nowMs: number): number {
    return Math.min(this.#receiverLimit, this.#most, this.#pathBitsPerSecond);
  }

  /** What the path may be given now, whatever the receiver wants of it. */
  get #pathBitsPerSecond(): number {
    const rate = this.#state === 'silent' ? this.#min : this.#estimate * (1 - this.#heldBack);
    return Math.max(rate, this.#min);
  }

  decision(nowMs: number): Readonly<RateDecision> {
    const d = this.#decision;
    d.targetBitsPerSecond = this.targetBitsPerSecond(nowMs);
    // What the receiver takes bounds how much is sent in all; how fast a frame goes is the path's matter.
    d.pacingBitsPerSecond = Math.max(this.#pathBitsPerSecond * PACING, LEAST_PACING);
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
    // Just before feedback comes, a round trip and an interval are in flight. One message may be missed without a halt;
    // not while a queue is there to be emptied.
    const missedMs = this.#state === 'drain' ? 0 : feedbackIntervalMs + 15;
    const rate = this.#estimate * (1 - (this.#state === 'drain' ? this.#heldBack : 0));
    const bytes = BitRate.bytesIn(rate, baseRttMs + feedbackIntervalMs + 5 + missedMs);
    if (this.#state === 'compete') return this.#competition.windowBytes + bytes;
    // A train fits in beside what is on its way.
    return Math.max(bytes, LEAST_WINDOW_BYTES) + (this.#probe.wish?.bytes ?? 0);
  }

  #onDelay(elapsedMs: number, nowMs: number): void {
    const { observation: o, noiseMs, baseRttMs } = this.#path;
    const allowanceMs = noiseAllowanceMs(noiseMs);
    const toleratedMs = toleratedQueueMs(this.#estimate) + allowanceMs;
    if (this.#state !== 'drain') this.#drainSinceMs = nowMs;
    else if (nowMs - this.#drainSinceMs > STUCK_MS && this.#path.settledQueueMs > toleratedMs / 2) {
      // However little is sent, it gets no shorter: no queue, but a longer way than before.
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
    if (reading === 'over') {
      const before = this.#estimate;
      this.#estimate = this.#delay.estimateWhenOver(this.#path, before, toleratedMs);
      this.#state = 'drain';
      // A train whose own queue ends it has found no more either.
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
      // Who sends no probes searches by doubling, 0.7 s each.
      const perSecond = this.#plan.searching ? this.#estimate : growth(this.#estimate);
      this.#estimate += (perSecond * elapsedMs) / 1000;
    }
    this.#heldBack = this.#state === 'drain' ? this.#delay.drain(o, allowanceMs) : 0;
  }

  /** The part of the estimate that the source uses. */
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
      this.#onOveruse(1, nowMs);
    } else if (verdict === 'innocent') {
      this.#estimate = Math.max(this.#estimate, this.#beforeTrial);
    }
  }

  #onProbe(results: readonly PacketResult[], nowMs: number): void {
    const outcome = this.#probe.onFeedback(results, this.#flight);
    if (outcome === null || this.#state !== 'steady') return;
    this.#estimate = this.#plan.onOutcome(outcome, this.#estimate, this.#path.noiseMs, nowMs);
  }

  #wishProbe(nowMs: number): void {
    if (this.#state !== 'steady' || this.#probe.busy || this.#loss.onTrial) return;
    if (this.#estimate >= this.#max) return;
    const idle = this.#used() < 0.5;
    if (!this.#plan.isDue(nowMs - this.#lastOveruseMs, idle, nowMs)) return;
    const rate = this.#plan.rate(this.#estimate, this.#max);
    this.#probe.ask(rate, this.#plan.bytes(rate, this.#path.noiseMs), nowMs);
    this.#plan.onAsked(nowMs);
  }

  /** Feedback is back after a silence. */
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
