import { BitRate } from '@farpoint/timing';
import { packetMs } from './delay-law.ts';
import type { PathObservation } from './path-observer.ts';
import { TcpShare } from './tcp-share.ts';

/** The queue has stood for so long in spite of our draining: somebody else fills it, ms. */
const STANDING_MS = 800;
/** A queue below this is not standing, ms. */
const EMPTY_MS = 10;
/** A queue that grows faster than this, ms per ms, is a link that has become slower. */
const COLLAPSE = 0.33;
/** The best rate of late is forgotten with this time constant, ms. */
const PEAK_MS = 10_000;
/** While a share test runs, this part of the rate is sent. */
const TEST_PART = 0.5;
const TEST_FIRST_MS = 1000;
const TEST_EVERY_MS = 4000;
const TEST_SELDOM_MS = 8000;
/** Our rate rose by so much since the last test: the competitor may have left. */
const RISEN = 1.4;
/** The competitor is gone when the queue has been nearly empty for so long, ms. */
const CALM_MS = 500;

/**
 * Notices a competitor that fills the queue (a TCP download), and holds its ground against it by behaving as a TCP flow
 * would. It tests now and then whether the competitor is still there: it halves its rate for a moment. Alone, the queue then
 * shrinks as fast as our rate fell; beside a competitor that holds most of the queue, it hardly does.
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
   * To be called for each message while not competing.
   *
   * @param drain the part of the rate that is held back to empty the queue
   * @returns whether the queue stands although we drain it
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
    // Draining in vain has cost us our share: begin near what we had.
    const rate = Math.min(this.#peak, 8 * estimate);
    this.#tcp.start(rate, baseRttMs + o.queueMs, nowMs);
    this.#testEveryMs = TEST_EVERY_MS;
    this.#nextTestMs = nowMs + TEST_FIRST_MS;
    this.#testUntilMs = Number.NaN;
    this.#calmMs = 0;
    this.#standingMs = 0;
  }

  /**
   * One feedback message while competing.
   *
   * @param congested loss beyond the link's own
   * @returns the rate to send at, bit/s; `null`: the competitor is gone
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

  /** What is held back because of a test, as a part of the rate. */
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
      // Alone, that empties about half of the queue.
      this.#testUntilMs = nowMs + Math.max(1.2 * o.queueEndMs, 60);
      this.#nextTestMs = nowMs + this.#testEveryMs;
      this.#testEveryMs = Math.min(this.#testEveryMs * 1.5, TEST_SELDOM_MS);
      return false;
    }
    if (!congested && o.newestSentMs < this.#testUntilMs) return false;
    const alone = (this.#testUntilMs - this.#testFromMs) * (1 - TEST_PART);
    this.#testUntilMs = Number.NaN;
    // With loss in it a test says nothing: the competitor has reduced as well.
    return !congested && this.#testQueueMs - o.queueEndMs > 0.75 * alone;
  }
}
