import { InFlight } from './in-flight.ts';
import { LossJudge } from './loss-judge.ts';
import { PathObserver } from './path-observer.ts';
import { ProbeTester } from './probe-tester.ts';
import type {
  PacketResult,
  RateController,
  RateDecision,
  RateSnapshot,
  ReceiverSums,
} from './rate-controller.ts';
import { TcpShare } from './tcp-share.ts';

export interface AdaptiveRateOptions {
  /** Before anything is known of the path, bit/s. */
  startBitsPerSecond?: number;
  minBitsPerSecond?: number;
  /** What the sources could use at the most, bit/s. */
  maxBitsPerSecond?: number;
}

type State = 'start' | 'steady' | 'drain' | 'compete' | 'silent';

const PACKET_BYTES = 1250;
/** Of what got through while the queue stood, the part that is planned for. */
const KEEP = 0.96;
/** A feedback message is missed when so many intervals, and so long, have passed without one. */
const SILENT_INTERVALS = 4;
const SILENT_MS = 500;
/** In silence, so many packets may go out each so often. */
const TRICKLE_PACKETS = 8;
const TRICKLE_MS = 500;
const LEAST_WAIT_MS = 250;
const MOST_WAIT_MS = 1400;

/** Queueing delay that is tolerated, ms. More at low rates: so flows of different rates come to the same one. */
function toleratedQueueMs(bitsPerSecond: number): number {
  return Math.min(Math.max(8 * Math.cbrt(20e6 / bitsPerSecond), 6), 25);
}

/** bit/s per s: grows with the square root of the rate, so that a small flow gains on a large one. */
function growth(bitsPerSecond: number): number {
  return 0.4e6 * Math.sqrt(bitsPerSecond / 1e6);
}

/**
 * Finds the rate that a path carries, with little waiting in its queue. See docs/congestion.md.
 */
export class AdaptiveRateController implements RateController {
  readonly #min: number;
  readonly #max: number;
  readonly #path = new PathObserver();
  readonly #flight = new InFlight();
  readonly #loss = new LossJudge();
  readonly #probe = new ProbeTester();
  readonly #tcp = new TcpShare();
  #estimate: number;
  #state: State = 'start';
  #drain = 0;
  #receiverLimit = Number.POSITIVE_INFINITY;
  #lastFeedbackMs = Number.NaN;
  #lastOveruseMs = Number.NEGATIVE_INFINITY;
  #lastProbeMs = Number.NEGATIVE_INFINITY;
  #nextProbeFactor = 3;
  #silentSinceMs = Number.NaN;
  /** Packets that left before this time tell nothing of the present path. */
  #ignoreLossBeforeMs = Number.NEGATIVE_INFINITY;
  #trickleMs = 0;
  #trickleBytes = 0;
  #beforeTrial = 0;
  #over = 0;
  #failures = 0;
  #standingMs = 0;
  #lastQueueEndMs = 0;
  #lastSentMs = 0;
  #probeWaitMs = LEAST_WAIT_MS;
  #beforeStanding = 0;
  #nextTestMs = 0;
  #testFromMs = 0;
  #testUntilMs = Number.NaN;
  #testQueueMs = 0;
  #calmMs = 0;
  readonly #decision: RateDecision = {
    targetBitsPerSecond: 0,
    pacingBitsPerSecond: 0,
    congestionWindowBytes: 0,
    bytesInFlight: 0,
    probe: null,
  };

  constructor(options: AdaptiveRateOptions = {}) {
    this.#min = options.minBitsPerSecond ?? 150_000;
    this.#max = options.maxBitsPerSecond ?? 200e6;
    this.#estimate = options.startBitsPerSecond ?? 3e6;
  }

  onPacketSent(transportSequence: number, bytes: number, nowMs: number, probeCluster = 0): void {
    if (Number.isNaN(this.#lastFeedbackMs)) this.#lastFeedbackMs = nowMs;
    if (this.#flight.bytes === 0) this.#lastFeedbackMs = Math.max(this.#lastFeedbackMs, nowMs);
    this.#flight.onSent(transportSequence, bytes, probeCluster);
    if (probeCluster !== 0) this.#probe.onSent(bytes, probeCluster, nowMs);
  }

  onFeedback(results: readonly PacketResult[], nowMs: number): void {
    const newest = results[results.length - 1];
    if (newest === undefined) return;
    const elapsedMs = Math.min(Math.max(nowMs - this.#lastFeedbackMs, 0), 200);
    this.#lastFeedbackMs = nowMs;
    this.#flight.onAnswered(newest.transportSequence);
    const arrived = this.#path.onFeedback(results, nowMs);
    if (this.#state === 'silent') this.#resume(nowMs);
    if (arrived) this.#onDelay(elapsedMs, nowMs);
    this.#onLoss(nowMs);
    if (arrived) this.#onProbe(results, nowMs);
    this.#estimate = Math.min(Math.max(this.#estimate, this.#min), this.#max);
  }

  onReceiverReport(_report: ReceiverSums, _nowMs: number): void {}

  onReceiverLimit(bitsPerSecond: number, _nowMs: number): void {
    this.#receiverLimit = Math.max(bitsPerSecond, 0);
  }

  onTick(nowMs: number): void {
    this.#probe.onTick(nowMs, this.#path.baseRttMs);
    if (this.#state === 'silent') {
      if (nowMs - this.#trickleMs >= TRICKLE_MS) {
        this.#trickleMs = nowMs;
        this.#trickleBytes = this.#flight.bytes + TRICKLE_PACKETS * PACKET_BYTES;
      }
      return;
    }
    const patience = Math.max(
      SILENT_MS,
      SILENT_INTERVALS * this.#path.feedbackIntervalMs + this.#path.baseRttMs,
    );
    if (this.#flight.bytes > 0 && nowMs - this.#lastFeedbackMs > patience) {
      this.#state = 'silent';
      this.#silentSinceMs = this.#lastFeedbackMs;
      this.#trickleMs = Number.NEGATIVE_INFINITY;
      this.#probe.cancel();
      this.onTick(nowMs);
    } else this.#wishProbe(nowMs);
  }

  targetBitsPerSecond(_nowMs: number): number {
    if (this.#state === 'silent') return Math.min(this.#receiverLimit, this.#min, this.#estimate);
    return Math.min(this.#receiverLimit, Math.max(this.#estimate * (1 - this.#drain), this.#min));
  }

  decision(nowMs: number): Readonly<RateDecision> {
    const d = this.#decision;
    d.targetBitsPerSecond = this.targetBitsPerSecond(nowMs);
    d.pacingBitsPerSecond = Math.max(d.targetBitsPerSecond * 1.1, 300_000);
    d.bytesInFlight = this.#flight.bytes;
    d.congestionWindowBytes = this.#window();
    d.probe = this.#state === 'silent' ? null : this.#probe.wish;
    return d;
  }

  snapshot(_nowMs: number): RateSnapshot {
    const o = this.#path.observation;
    return {
      estimateBitsPerSecond: this.#estimate,
      state: this.#state,
      lossFraction: this.#loss.fraction,
      rttMs: o.rttMs > 0 ? o.rttMs : null,
      queueMs: o.queueMs,
      ackedBitsPerSecond: o.ackedBitsPerSecond,
    };
  }

  #window(): number {
    if (this.#state === 'silent') return this.#trickleBytes;
    // One feedback message may be missed without a halt.
    const missed = this.#state === 'drain' ? 0 : this.#path.feedbackIntervalMs + 15;
    const ms = this.#path.baseRttMs + this.#path.feedbackIntervalMs + 5 + missed;
    if (this.#state === 'compete') return Math.max(this.#tcp.windowBytes, 1) + (this.#estimate * ms) / 8000;
    return Math.max((this.#estimate * (1 - this.#drain) * ms) / 8000, 6 * PACKET_BYTES);
  }

  #onDelay(elapsedMs: number, nowMs: number): void {
    const o = this.#path.observation;
    const noise = 3 * Math.max(this.#path.noiseMs - 2, 0);
    const tolerated = toleratedQueueMs(this.#estimate) + noise;
    const queue = Math.min(o.queueMs, o.queueEndMs * 1.5 + 2);
    const slope = (o.queueEndMs - this.#lastQueueEndMs) / Math.max(o.newestSentMs - this.#lastSentMs, 1);
    this.#lastQueueEndMs = o.queueEndMs;
    this.#lastSentMs = o.newestSentMs;
    if (queue < Math.min(tolerated, 15 + noise)) {
      this.#standingMs = Math.max(this.#standingMs - 4 * elapsedMs, 0);
      if (this.#standingMs === 0 && this.#state === 'steady') this.#beforeStanding = this.#estimate;
    } else if (slope > -0.4 * this.#drain && slope < 0.33) this.#standingMs += elapsedMs;
    else this.#standingMs = Math.max(this.#standingMs - elapsedMs, 0);
    if (this.#state === 'compete') {
      this.#compete(tolerated, elapsedMs, nowMs);
      return;
    }
    if (this.#standingMs > 800) {
      this.#state = 'compete';
      this.#drain = 0;
      this.#standingMs = 0;
      this.#tcp.start(this.#beforeStanding, this.#path.baseRttMs + o.queueMs, nowMs);
      this.#nextTestMs = nowMs + 1000;
      this.#testUntilMs = Number.NaN;
      this.#compete(tolerated, elapsedMs, nowMs);
      return;
    }
    this.#over = queue > tolerated || o.queueEndMs > 1.5 * tolerated ? this.#over + 1 : 0;
    if (this.#over >= (this.#path.noiseMs > 3 ? 2 : 1) || o.queueEndMs > 2.5 * tolerated) {
      const rate =
        o.queueEndMs > 2 * tolerated
          ? Math.min(o.ackedBitsPerSecond, o.recentBitsPerSecond)
          : o.ackedBitsPerSecond;
      this.#estimate = Math.min(this.#estimate, KEEP * rate);
      this.#state = 'drain';
      this.#lastOveruseMs = nowMs;
      this.#nextProbeFactor = 1.5;
      this.#probe.cancel();
    } else if (this.#state === 'drain' && queue < tolerated / 2) this.#state = 'steady';
    else if (this.#state === 'steady' && !this.#limited()) {
      this.#estimate += (growth(this.#estimate) * elapsedMs) / 1000;
    }
    // The queue should be gone in 150 ms.
    this.#drain = this.#state === 'drain' ? Math.min(Math.max(o.queueEndMs - noise - 2, 0) / 150, 0.6) : 0;
  }

  #compete(tolerated: number, elapsedMs: number, nowMs: number): void {
    const o = this.#path.observation;
    const rtt = this.#path.baseRttMs + Math.max(o.queueEndMs, 0);
    const n = o.received + o.lost;
    const expected = n * this.#loss.base;
    const congested = o.lost > expected + 3 * Math.sqrt(expected);
    this.#tcp.update(rtt, congested, o.oldestSentMs, elapsedMs, nowMs);
    this.#estimate = (this.#tcp.windowBytes * 8000) / rtt;
    if (!Number.isNaN(this.#testUntilMs)) {
      if (congested) this.#testUntilMs = Number.NaN;
      else if (o.newestSentMs >= this.#testUntilMs) {
        const fell = this.#testQueueMs - o.queueEndMs;
        const alone = (this.#testUntilMs - this.#testFromMs) * 0.5;
        this.#testUntilMs = Number.NaN;
        if (fell > 0.75 * alone) this.#leave();
      }
    } else if (nowMs > this.#nextTestMs && o.queueEndMs > tolerated) {
      this.#testFromMs = nowMs;
      this.#testQueueMs = o.queueEndMs;
      this.#testUntilMs = nowMs + Math.max(1.2 * o.queueEndMs, 60);
      this.#nextTestMs = nowMs + 4000;
    }
    this.#drain = nowMs < this.#testUntilMs ? 0.5 : 0;
    if (o.queueMs < tolerated / 2) this.#calmMs += elapsedMs;
    else this.#calmMs = 0;
    if (this.#calmMs > 500) this.#leave();
  }

  #leave(): void {
    this.#state = 'drain';
    this.#standingMs = 0;
    this.#calmMs = 0;
    this.#testUntilMs = Number.NaN;
  }

  /** The source did not use what it had. */
  #limited(): boolean {
    return this.#path.observation.ackedBitsPerSecond < 0.75 * this.#estimate * (1 - this.#loss.base);
  }

  #onLoss(nowMs: number): void {
    const o = this.#path.observation;
    if (o.oldestSentMs < this.#ignoreLossBeforeMs) return;
    switch (this.#loss.onFeedback(o.received, o.lost, o.oldestSentMs, nowMs)) {
      case 'excess':
        this.#beforeTrial = this.#estimate;
        this.#estimate = Math.min(
          this.#estimate,
          Math.max((0.95 * o.ackedBitsPerSecond) / (1 - this.#loss.base), 0.85 * this.#estimate),
        );
        this.#loss.cutAt(nowMs);
        this.#probe.cancel();
        this.#lastOveruseMs = nowMs;
        this.#nextProbeFactor = 1.5;
        if (this.#state === 'start') this.#state = 'steady';
        break;
      case 'innocent':
        if (this.#state === 'steady') this.#estimate = Math.max(this.#estimate, this.#beforeTrial);
        break;
      default:
    }
  }

  #onProbe(results: readonly PacketResult[], nowMs: number): void {
    const outcome = this.#probe.onFeedback(results, this.#flight);
    if (outcome === null || this.#state === 'drain' || this.#state === 'compete') return;
    const { sentBitsPerSecond: sent, arrivedBitsPerSecond: arrived } = outcome;
    const noisy = this.#path.noiseMs > 3;
    if (arrived >= (noisy ? 0.7 : 0.9) * sent) {
      this.#failures = 0;
      this.#estimate = Math.max(this.#estimate, 0.95 * Math.min(sent, arrived));
      this.#nextProbeFactor = this.#state === 'start' ? 3 : 2;
      this.#probeWaitMs = 0;
      return;
    }
    const part = this.#state === 'start' ? 1 : 0.6;
    const gain = part * (0.93 * arrived - this.#estimate);
    this.#probeWaitMs = Math.min(Math.max(2 * this.#probeWaitMs, LEAST_WAIT_MS), MOST_WAIT_MS);
    this.#nextProbeFactor = 1.5;
    if (++this.#failures >= (noisy ? 3 : 1)) this.#state = 'steady';
    if (gain > 0) this.#estimate += gain;
    if (gain > 0.15 * this.#estimate) this.#probeWaitMs = LEAST_WAIT_MS;
    this.#lastProbeMs = nowMs;
  }

  #wishProbe(nowMs: number): void {
    if (this.#probe.busy || this.#loss.onTrial) return;
    const wait = this.#state === 'start' ? 0 : this.#probeWaitMs;
    if (this.#state !== 'start' && this.#state !== 'steady') return;
    if (nowMs - this.#lastProbeMs < wait || nowMs - this.#lastOveruseMs < Math.max(wait, LEAST_WAIT_MS))
      return;
    if (this.#estimate >= this.#max) return;
    const rate = Math.min(this.#nextProbeFactor * this.#estimate, this.#max * 1.1);
    const ms = 15 + 3 * Math.max(this.#path.noiseMs - 2, 0);
    this.#probe.ask(rate, Math.max((rate * ms) / 8000, 8 * PACKET_BYTES), nowMs);
    this.#lastProbeMs = nowMs;
  }

  /** Feedback is back after a silence. */
  #resume(nowMs: number): void {
    const seconds = (nowMs - this.#silentSinceMs) / 1000;
    this.#estimate = Math.max(
      Math.min(this.#estimate, Math.max(1e6, this.#estimate * 0.5 ** seconds)),
      this.#min,
    );
    this.#state = 'start';
    this.#nextProbeFactor = 3;
    this.#ignoreLossBeforeMs = nowMs;
    this.#loss.forget();
    this.#drain = 0;
  }
}
