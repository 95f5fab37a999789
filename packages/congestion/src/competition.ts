import { BitRate } from '@farpoint/timing';
import { packetMs } from './delay-law.ts';
import type { PathObservation } from './path-observer.ts';
import { TcpShare } from './tcp-share.ts';

// What these numbers give together with the others: see adaptive-rate-controller.ts.

/** If the queue has stood for this long despite draining, somebody else is filling it, ms. */
const STANDING_MS = 800;
/** A queue shorter than this does not count as standing, ms. */
const EMPTY_MS = 10;
/** If a queue grows faster than this, the link has become slower, ms per ms. */
const COLLAPSE = 0.33;
/** Time constant with which the recent peak rate is forgotten, ms. */
const PEAK_MS = 10_000;
/** The fraction of the rate that is sent during a share test. */
const TEST_PART = 0.5;
/**
 * When the first test comes, and the usual and the longest time between two, ms: each halves the rate for a
 * moment.
 */
const TEST_FIRST_MS = 1000;
const TEST_EVERY_MS = 4000;
const TEST_SELDOM_MS = 8000;
/** If our rate has risen by this factor since the last test, the competitor may have left. */
const RISEN = 1.4;
/** The competitor is considered gone once the queue has been nearly empty for this long, ms. */
const CALM_MS = 500;

/**
 * Detects a competitor that fills the queue (such as a TCP download) and keeps a fair share by behaving as a TCP flow
 * would. From time to time it halves its rate for a moment to test whether the competitor is still there. Without a
 * competitor, the queue then shrinks as fast as our rate fell; beside one that holds most of the queue, it hardly
 * shrinks.
 */
export class Competition {
  readonly #tcp = new TcpShare();
  #standingMs = 0;
  #lastQueueMs = 0;
  #lastSentMs = 0;
  #peak = 0;
  #testEveryMs = TEST_EVERY_MS;
  #nextTestMs = 0;
  #testFromMs = 0;
  #testUntilMs = Number.NaN;
  #testQueueMs = 0;
  #testRate = 0;
  #calmMs = 0;

  get windowBytes(): number {
    return this.#tcp.windowBytes;
  }

  /**
   * Call for each feedback message while not competing.
   *
   * @param drain the fraction of the rate that is held back to empty the queue
   * @returns whether the queue stands although we are draining it
   */
  notice(
    o: Readonly<PathObservation>,
    estimate: number,
    drain: number,
    noiseMs: number,
    elapsedMs: number,
  ): boolean {
    const slope = (o.queueEndMs - this.#lastQueueMs) / Math.max(o.newestSentMs - this.#lastSentMs, 1);
    this.#lastQueueMs = o.queueEndMs;
    this.#lastSentMs = o.newestSentMs;
    const empty = o.queueMs < EMPTY_MS + packetMs(estimate) + noiseMs;
    if (!empty && slope > -0.4 * drain && slope < COLLAPSE) this.#standingMs += elapsedMs;
    else this.#standingMs = Math.max(this.#standingMs - (empty ? 4 : 1) * elapsedMs, 0);
    this.#peak = Math.max(this.#peak * (1 - elapsedMs / PEAK_MS), estimate);
    return this.#standingMs > STANDING_MS;
  }

  begin(o: Readonly<PathObservation>, estimate: number, baseRttMs: number, nowMs: number): void {
    // Draining in vain has cost us our share, so begin near the rate we had.
    const rate = Math.min(this.#peak, 8 * estimate);
    this.#tcp.start(rate, baseRttMs + o.queueMs, nowMs);
    this.#testEveryMs = TEST_EVERY_MS;
    this.#nextTestMs = nowMs + TEST_FIRST_MS;
    this.#testUntilMs = Number.NaN;
    this.#calmMs = 0;
    this.#standingMs = 0;
  }

  /**
   * Processes one feedback message while competing.
   *
   * @param congested whether there is loss beyond the link's own
   * @returns the rate to send at, bit/s; `null` once the competitor is gone
   */
  update(
    o: Readonly<PathObservation>,
    congested: boolean,
    baseRttMs: number,
    toleratedMs: number,
    elapsedMs: number,
    nowMs: number,
  ): number | null {
    const rttMs = baseRttMs + Math.max(o.queueEndMs, 0);
    this.#tcp.update(rttMs, congested, o.oldestSentMs, elapsedMs, nowMs);
    if (this.#testSaysAlone(o, congested, toleratedMs, nowMs)) return null;
    this.#calmMs = o.queueMs < toleratedMs / 2 ? this.#calmMs + elapsedMs : 0;
    return this.#calmMs > CALM_MS ? null : BitRate.of(this.#tcp.windowBytes, rttMs);
  }

  /** The fraction of the rate that a test holds back. */
  heldBack(nowMs: number): number {
    return nowMs < this.#testUntilMs ? 1 - TEST_PART : 0;
  }

  #testSaysAlone(
    o: Readonly<PathObservation>,
    congested: boolean,
    toleratedMs: number,
    nowMs: number,
  ): boolean {
    if (Number.isNaN(this.#testUntilMs)) {
      if (o.ackedBitsPerSecond > RISEN * this.#testRate && this.#testEveryMs > TEST_EVERY_MS) {
        this.#testEveryMs = TEST_EVERY_MS;
        this.#nextTestMs = Math.min(this.#nextTestMs, nowMs + TEST_FIRST_MS);
      }
      if (nowMs <= this.#nextTestMs || o.queueEndMs <= toleratedMs) return false;
      this.#testRate = o.ackedBitsPerSecond;
      this.#testFromMs = nowMs;
      this.#testQueueMs = o.queueEndMs;
      // Without a competitor, this empties about half of the queue.
      this.#testUntilMs = nowMs + Math.max(1.2 * o.queueEndMs, 60);
      this.#nextTestMs = nowMs + this.#testEveryMs;
      this.#testEveryMs = Math.min(this.#testEveryMs * 1.5, TEST_SELDOM_MS);
      return false;
    }
    if (!congested && o.newestSentMs < this.#testUntilMs) return false;
    const alone = (this.#testUntilMs - this.#testFromMs) * (1 - TEST_PART);
    this.#testUntilMs = Number.NaN;
    // A test with loss proves nothing: the competitor has reduced its rate as well.
    return !congested && this.#testQueueMs - o.queueEndMs > 0.75 * alone;
  }
}
