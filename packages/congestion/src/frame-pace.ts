import type { ProbeOutcome } from './probe-tester.ts';

// What these numbers give together with the others: see adaptive-rate-controller.ts.

/**
 * The fastest pace: this multiple of what the sources use, but not above this rate, bit/s. A frame of 300 kB
 * then takes 5 ms; to send it faster would win little, and switches and receivers would have to take it in
 * one piece. `pnpm bench bridge --profile --points 22500`: from shared memory to the page's socket 6.6 ms
 * instead of 12.8.
 */
const HEADROOM = 8;
const FASTEST = 500e6;
/** A train must arrive at this fraction of its sending rate: then the path has not spread it. */
const UNSPREAD = 0.9;
/** What is kept of the rate that a train has shown. */
const KEEP = 0.95;
const KEEP_SPREAD = 0.85;
/** From this fraction of the most on, nothing more is to be won. */
const ENOUGH = 0.9;
/** Each train goes by so much faster than the last. */
const FACTOR = 2;
/**
 * A path that is slower than the pace shows a queue in every frame, a receiver or path that stops for a moment in one.
 * So many messages that tell of a queue give the pace up; each without one takes a part of one back.
 */
const QUEUES = 3;
const FORGIVEN = 0.25;
/** The wait after a sign that the path is full, and after each further one or spread train twice as long, ms. */
const LEAST_WAIT_MS = 1000;
const MOST_WAIT_MS = 30_000;

/**
 * How fast the packets of one frame may follow each other on a path that carries more than all sources could use. It
 * shortens the way of a frame and raises no rate. When the path turns out to be full, frames go at the estimate's pace
 * again.
 */
export class FramePace {
  readonly #most: number;
  #bitsPerSecond = 0;
  #queues = 0;
  #waitMs = LEAST_WAIT_MS;
  #notBeforeMs = Number.NEGATIVE_INFINITY;

  /** @param sourcesBitsPerSecond the most that all sources together could use, bit/s */
  constructor(sourcesBitsPerSecond: number) {
    this.#most = Math.min(HEADROOM * sourcesBitsPerSecond, FASTEST);
  }

  /** What trains have shown, bit/s; 0 while they have shown nothing. */
  get bitsPerSecond(): number {
    return this.#bitsPerSecond;
  }

  /** @returns the rate of a train that is to be sent now, bit/s; `null` for none */
  trainRate(estimate: number, nowMs: number): number | null {
    if (nowMs < this.#notBeforeMs || this.#bitsPerSecond >= ENOUGH * this.#most || estimate >= this.#most)
      return null;
    return Math.min(FACTOR * Math.max(estimate, this.#bitsPerSecond), this.#most);
  }

  onOutcome({ sentBitsPerSecond, arrivedBitsPerSecond }: Readonly<ProbeOutcome>, nowMs: number): void {
    const unspread = arrivedBitsPerSecond >= UNSPREAD * sentBitsPerSecond;
    const shown = (unspread ? KEEP : KEEP_SPREAD) * Math.min(sentBitsPerSecond, arrivedBitsPerSecond);
    this.#bitsPerSecond = Math.min(Math.max(this.#bitsPerSecond, shown), this.#most);
    if (unspread) this.#waitMs = LEAST_WAIT_MS;
    else this.#wait(nowMs);
  }

  /** Nobody sent the train. */
  onUnsent(nowMs: number): void {
    this.#wait(nowMs);
  }

  /** @param queued whether a message tells of a queue */
  onMessage(queued: boolean, nowMs: number): void {
    this.#queues = queued ? this.#queues + 1 : Math.max(this.#queues - FORGIVEN, 0);
    if (this.#queues >= QUEUES) this.onFull(nowMs);
  }

  /** The path loses more than it should, or is silent: what was known of it no longer holds. */
  onFull(nowMs: number): void {
    this.#queues = 0;
    if (this.#bitsPerSecond === 0) return;
    this.#bitsPerSecond = 0;
    this.#wait(nowMs);
  }

  #wait(nowMs: number): void {
    this.#notBeforeMs = nowMs + this.#waitMs;
    this.#waitMs = Math.min(2 * this.#waitMs, MOST_WAIT_MS);
  }
}
