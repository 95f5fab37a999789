import { BitRate } from '@farpoint/timing';
import type { ProbeOutcome } from './probe-tester.ts';

// What these numbers give together with the others: see adaptive-rate-controller.ts.

/**
 * Length of a train: as time, and the minimum in bytes. Six packets of 1,250 bytes: five tell a rate
 * (probe-tester.ts).
 */
const TRAIN_MS = 15;
const TRAIN_BYTES = 7500;
/** Extra length for each ms of noise on the path, ms. */
const TRAIN_PER_NOISE = 4;
/** The wait between two trains, ms: it doubles with each that finds nothing, from the least to the most. */
const LEAST_WAIT_MS = 250;
const MOST_WAIT_MS = 1400;
/**
 * While the source does not use the rate it has, a higher one only shortens a frame's way. The wait doubles with each
 * train that has found a limit.
 */
const LEAST_IDLE_WAIT_MS = 1000;
const MOST_IDLE_WAIT_MS = 5000;
/** A cut that leaves less than this share may have been too deep: the next train comes soon. */
const DEEP_CUT = 0.6;
/** How much faster than the estimate a train is sent: usually, in the search, and after a success. */
const FACTOR = 1.5;
const FACTOR_AT_START = 3;
const FACTOR_AFTER_SUCCESS = 2;
/** A train that arrives at this fraction of its sending rate has found no limit. */
const UNLIMITED = 0.9;
const UNLIMITED_IN_NOISE = 0.75;
/** Noise that spoils the measurement, ms. */
const NOISY_MS = 2;

/** Decides when to try a higher rate, how high, and what follows from the outcome. */
export class ProbePlan {
  #factor = FACTOR_AT_START;
  #waitMs = LEAST_WAIT_MS;
  #lastMs = Number.NEGATIVE_INFINITY;
  #failures = 0;
  /** The path's rate is entirely unknown. */
  searching = true;
  /** The sender does not send probes, so the search has to do without them. */
  ignored = false;

  restart(): void {
    this.searching = true;
    this.#factor = FACTOR_AT_START;
    this.#failures = 0;
  }

  /**
   * The path turned out to be full.
   *
   * @param kept the fraction of the estimate that is left
   */
  onOveruse(kept: number): void {
    this.searching = false;
    this.#factor = FACTOR;
    // A deep cut may have been too deep.
    if (kept < DEEP_CUT) this.#waitMs = LEAST_WAIT_MS;
  }

  onIgnored(): void {
    this.ignored = true;
  }

  /** A train was aborted because the queue grew too long meanwhile. */
  onCut(nowMs: number): void {
    if (this.searching) return;
    this.#waitMs = Math.min(Math.max(2 * this.#waitMs, LEAST_WAIT_MS), MOST_WAIT_MS);
    this.#lastMs = nowMs;
  }

  /** @returns whether it is time for a train */
  isDue(sinceOveruseMs: number, idle: boolean, nowMs: number): boolean {
    const idleMs = Math.min(LEAST_IDLE_WAIT_MS * 2 ** this.#failures, MOST_IDLE_WAIT_MS);
    const waitMs = this.searching ? 0 : idle ? idleMs : this.#waitMs;
    return nowMs - this.#lastMs >= waitMs && sinceOveruseMs >= Math.max(waitMs, LEAST_WAIT_MS);
  }

  /** @returns the rate of the next train, bit/s */
  rate(estimate: number, mostBitsPerSecond: number): number {
    return Math.min(this.#factor * estimate, 1.1 * mostBitsPerSecond);
  }

  bytes(rate: number, noiseMs: number): number {
    return Math.max(BitRate.bytesIn(rate, TRAIN_MS + TRAIN_PER_NOISE * noiseMs), TRAIN_BYTES);
  }

  onAsked(nowMs: number): void {
    this.#lastMs = nowMs;
  }

  /** @returns the new estimate, never lower */
  onOutcome(outcome: Readonly<ProbeOutcome>, estimate: number, noiseMs: number, nowMs: number): number {
    this.ignored = false;
    const { sentBitsPerSecond: sent, arrivedBitsPerSecond: arrived } = outcome;
    const noisy = noiseMs > NOISY_MS;
    if (arrived >= (noisy ? UNLIMITED_IN_NOISE : UNLIMITED) * sent) {
      this.#failures = 0;
      this.#factor = this.searching ? FACTOR_AT_START : FACTOR_AFTER_SUCCESS;
      this.#waitMs = 0;
      return Math.max(estimate, 0.95 * Math.min(sent, arrived));
    }
    // The train was spread out: it arrived at the link's rate, or at our share of it if others send as well. If the
    // train before found no limit, this is the first limit seen: nothing else is known, as in the search.
    const known = !this.searching && this.#factor !== FACTOR_AFTER_SUCCESS;
    const gain = (known ? 0.6 : 0.75) * (0.93 * arrived - estimate);
    this.#waitMs = Math.min(Math.max(2 * this.#waitMs, LEAST_WAIT_MS), MOST_WAIT_MS);
    if (gain > 0.15 * estimate) this.#waitMs = LEAST_WAIT_MS;
    this.#factor = FACTOR;
    if (++this.#failures >= (noisy ? 3 : 1)) this.searching = false;
    this.#lastMs = nowMs;
    return estimate + Math.max(gain, 0);
  }
}
