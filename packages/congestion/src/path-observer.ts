import { type PacketResult, SequenceNumber } from '@farpoint/rtp';
import { BitRate, WindowedMinimum } from '@farpoint/timing';
import { SettledDelay } from './settled-delay.ts';

/** Summary of one feedback message. The next message overwrites it. */
export interface PathObservation {
  received: number;
  lost: number;
  receivedBytes: number;
  /**
   * Queueing delay of the path, ms: the value that most packets of the message exceed, and the median of its newest
   * packets.
   */
  queueMs: number;
  queueEndMs: number;
  /** Arrival rate over the last 100 ms or so, bit/s. */
  ackedBitsPerSecond: number;
  /** From sending the newest packet to receiving the feedback about it, ms. */
  rttMs: number;
  /** When the newest and the oldest packet of the message were sent, ms. */
  newestSentMs: number;
  oldestSentMs: number;
}

// What these numbers give together with the others: see adaptive-rate-controller.ts.

/** Base delay and base round trip are minima over this window. Clocks differ by up to 100 ppm: 3 ms in 30 s. */
export const BASE_WINDOW_MS = 30_000;
/** If the one-way delay grew by this much more than the round trip did, a clock has jumped, ms. */
const CLOCK_JUMP_MS = 60;
/**
 * What has arrived over this time is the rate, ms: more than one message of Chromium, which comes every
 * 50–62 ms.
 */
const RATE_WINDOW_MS = 95;
/** The queue at the end of a message is the least delay of this many packets: one late packet is no queue. */
const END_PACKETS = 4;
/** A rate is computed from at least this many packets. */
const RATE_PACKETS = 8;
/** Messages that are remembered: the window holds all of them if one came every 3 ms. */
const MESSAGES = 32;
const NOISE_CLAMP_MS = 16;

/** Turns feedback into queueing delay, arrival rate, loss and round trip. It draws no conclusions from them. */
export class PathObserver {
  readonly observation: PathObservation = {
    received: 0,
    lost: 0,
    receivedBytes: 0,
    queueMs: 0,
    queueEndMs: 0,
    ackedBitsPerSecond: 0,
    rttMs: 0,
    newestSentMs: 0,
    oldestSentMs: 0,
  };
  readonly #baseDelay = new WindowedMinimum(BASE_WINDOW_MS);
  readonly #baseRtt = new WindowedMinimum(BASE_WINDOW_MS);
  readonly #settled = new SettledDelay();
  /** The last messages: newest arrival time and bytes of each. */
  readonly #ends = new Float64Array(MESSAGES);
  readonly #bytes = new Float64Array(MESSAGES);
  #messages = 0;
  #delays = new Float64Array(1024);
  #sorted = new Float64Array(1024);
  #arrivals = new Float64Array(1024);
  #sizes = new Float64Array(1024);
  #lastMs = Number.NEGATIVE_INFINITY;
  #newestSequence = -1;
  #lastQueueMs = 0;
  #changes = 0;
  #lastChange = 0;
  #opposed = 0;
  /**
   * Standard deviation of the delay noise between messages, ms. Noise shows as changes followed by opposite ones (for
   * independent samples, half the variance of the changes); a queue grows or shrinks over several messages.
   */
  noiseMs = 0;
  /** Smoothed time between feedback messages, ms. */
  feedbackIntervalMs = 60;
  /** How many jumps of the receiver's clock were detected. */
  clockJumps = 0;

  /** The least recent round trip, ms; a guess before the first sample. */
  get baseRttMs(): number {
    const value = this.#baseRtt.value;
    return value < Number.POSITIVE_INFINITY ? value : 100;
  }

  /** How far the floor to which the delay keeps falling lies above the base delay, ms; NaN if there is no floor. */
  get settledQueueMs(): number {
    return this.#settled.value - this.#baseDelay.value;
  }

  /** Records that the path has become longer: at the floor, there is no queue. */
  lengthen(nowMs: number): void {
    const delay = this.#settled.value;
    this.#baseDelay.reset();
    this.#baseDelay.add(delay, nowMs);
    this.#baseRtt.reset();
    this.#baseRtt.add(this.observation.rttMs, nowMs);
    this.#settled.reset();
  }

  /** Discards earlier arrivals, which say nothing about the present rate, for example after an outage. */
  forgetRates(): void {
    this.#newestSequence = -1;
  }

  /**
   * The highest arrival rate in any `windowMs` of the last message while its queue stood, bit/s: what the path carries
   * for us. A short stall of the path, the receiver or the sender leaves other windows unaffected.
   *
   * @param leastMs packets that waited for less saw no queue
   * @param haltMs packets before a gap of this length between two arrivals do not count
   * @returns NaN if the queue is too young to give a rate
   */
  rateWhileQueued(leastMs: number, windowMs: number, haltMs = Number.POSITIVE_INFINITY): number {
    const n = this.observation.received;
    const queued = this.#baseDelay.value + Math.max(this.observation.queueEndMs / 2, leastMs);
    let begin = n;
    while (begin > 0 && (this.#delays[begin - 1] as number) >= queued) {
      const gapMs = begin < n ? (this.#arrivals[begin] as number) - (this.#arrivals[begin - 1] as number) : 0;
      if (gapMs >= haltMs) break;
      begin--;
    }
    let most = Number.NaN;
    let bytes = 0;
    let from = begin;
    for (let to = begin + 1; to < n; to++) {
      const arrival = this.#arrivals[to] as number;
      bytes += this.#sizes[to] as number;
      while (arrival - (this.#arrivals[from + 1] as number) >= windowMs && to - from > RATE_PACKETS)
        bytes -= this.#sizes[++from] as number;
      const spanMs = arrival - (this.#arrivals[from] as number);
      if (spanMs < windowMs || to - from < RATE_PACKETS) continue;
      const rate = BitRate.of(bytes, spanMs);
      if (!(rate <= most)) most = rate;
    }
    return most;
  }

  /** @returns false if no packet of the message arrived, so that only the loss is new */
  onFeedback(results: readonly PacketResult[], nowMs: number): boolean {
    const o = this.observation;
    o.received = 0;
    o.lost = 0;
    o.receivedBytes = 0;
    o.newestSentMs = Number.NEGATIVE_INFINITY;
    o.oldestSentMs = Number.POSITIVE_INFINITY;
    if (results.length > this.#delays.length) {
      this.#delays = new Float64Array(results.length * 2);
      this.#sorted = new Float64Array(results.length * 2);
      this.#arrivals = new Float64Array(results.length * 2);
      this.#sizes = new Float64Array(results.length * 2);
    }
    let newestArrivalMs = Number.NEGATIVE_INFINITY;
    let rttMs = 0;
    const first = results[0]?.transportSequence ?? 0;
    const gap = this.#newestSequence < 0 || SequenceNumber.ahead(first, this.#newestSequence) !== 1;
    this.#newestSequence = results[results.length - 1]?.transportSequence ?? this.#newestSequence;
    for (const { arrivalUs, sentMs, bytes } of results) {
      if (sentMs < o.oldestSentMs) o.oldestSentMs = sentMs;
      if (arrivalUs === null) {
        o.lost++;
        continue;
      }
      const arrivalMs = arrivalUs / 1000;
      this.#delays[o.received] = arrivalMs - sentMs;
      this.#arrivals[o.received] = arrivalMs;
      this.#sizes[o.received] = bytes;
      o.received++;
      o.receivedBytes += bytes;
      if (arrivalMs > newestArrivalMs) newestArrivalMs = arrivalMs;
      if (sentMs > o.newestSentMs) {
        o.newestSentMs = sentMs;
        rttMs = nowMs - sentMs;
      }
    }
    if (nowMs - this.#lastMs < 1000 && nowMs > this.#lastMs)
      this.feedbackIntervalMs += (nowMs - this.#lastMs - this.feedbackIntervalMs) * 0.1;
    this.#lastMs = nowMs;
    if (o.received === 0) return false;
    o.rttMs = rttMs;
    this.#baseRtt.add(rttMs, nowMs);
    if (!this.#queue(rttMs, nowMs)) return false;
    this.#rates(newestArrivalMs, gap);
    return true;
  }

  /** @returns false if the clock jumped, so that the message is useless */
  #queue(rttMs: number, nowMs: number): boolean {
    const o = this.observation;
    const n = o.received;
    let endDelay = Number.POSITIVE_INFINITY;
    for (let i = Math.max(0, n - END_PACKETS); i < n; i++)
      endDelay = Math.min(endDelay, this.#delays[i] as number);
    this.#sorted.set(this.#delays.subarray(0, n));
    const all = this.#sorted.subarray(0, n).sort();
    const queuedAtMost = Math.max(rttMs - this.baseRttMs, 0);
    if (endDelay - this.#baseDelay.value > queuedAtMost + CLOCK_JUMP_MS) {
      this.clockJumps++;
      this.#baseDelay.reset();
      this.#baseDelay.add(endDelay - queuedAtMost, nowMs);
      this.#settled.reset();
      this.#messages = 0;
      return false;
    }
    const delay = all[Math.floor(n / 10)] as number;
    this.#baseDelay.add(delay, nowMs);
    this.#settled.add(delay);
    const base = this.#baseDelay.value;
    o.queueMs = delay - base;
    const change = Math.min(Math.max(o.queueMs - this.#lastQueueMs, -NOISE_CLAMP_MS), NOISE_CLAMP_MS);
    this.#changes++;
    const gain = Math.max(0.03, 1 / (this.#changes + 3));
    this.#opposed += (-change * this.#lastChange - this.#opposed) * gain;
    this.noiseMs = Math.sqrt(Math.max(this.#opposed, 0));
    this.#lastChange = change;
    this.#lastQueueMs = o.queueMs;
    o.queueEndMs = endDelay - base;
    return true;
  }

  #rates(newestArrivalMs: number, gap: boolean): void {
    const o = this.observation;
    const last = this.#messages > 0 ? (this.#ends[(this.#messages - 1) % MESSAGES] as number) : Number.NaN;
    if (gap || newestArrivalMs < last || newestArrivalMs > last + 2000) {
      // A message is missing, the clock jumped, or there was a long silence: judge this message by itself.
      this.#messages = 0;
      this.#push(this.#arrivals[0] as number, 0);
      this.#push(newestArrivalMs, o.receivedBytes - (this.#sizes[0] as number));
    } else this.#push(newestArrivalMs, o.receivedBytes);
    let bytes = 0;
    let spanMs = 0;
    for (
      let back = 0;
      back + 1 < Math.min(this.#messages, MESSAGES) && spanMs < RATE_WINDOW_MS + 20 * this.noiseMs;
      back++
    ) {
      bytes += this.#bytes[(this.#messages - 1 - back) % MESSAGES] as number;
      spanMs = newestArrivalMs - (this.#ends[(this.#messages - 2 - back) % MESSAGES] as number);
    }
    if (spanMs > 0) o.ackedBitsPerSecond = BitRate.of(bytes, spanMs);
  }

  #push(endMs: number, bytes: number): void {
    this.#ends[this.#messages % MESSAGES] = endMs;
    this.#bytes[this.#messages % MESSAGES] = bytes;
    this.#messages++;
  }
}
