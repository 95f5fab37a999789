/** Runs latency tests, one or many after another, and keeps what they measured. Time is passed in. */
import { type Distribution, LatencyError, type LatencyReport, SampleWindow } from '@farpoint/operator';
import { type ReadonlySignal, signal } from '@preact/signals-core';
import type { LatencyTestEnd } from '../../words/latency-words.ts';

export interface LatencyRunsPort {
  /** @param startedAtMs page's clock, ms @throws {LatencyError} if it has no result */
  test(startedAtMs: number): Promise<LatencyReport>;
  /** Page's clock, ms. */
  now(): number;
  /** Milliseconds since the epoch. */
  epochMs(): number;
  /** Calls back after this time, ms. */
  after(ms: number, act: () => void): void;
}

/** From the end of one test to the next, ms: at most two a second, so that green clouds do not hide the view. */
export const PAUSE_MS = 500;
/** Ends of tests that are kept. Chosen: the paper's figures have as many, and p95 has five above it. */
export const MOST_ENDS = 100;

export class LatencyRuns {
  readonly #port: LatencyRunsPort;
  readonly #ends = signal<readonly LatencyTestEnd[]>([]);
  readonly #continuous = signal(false);
  /** Numbers the runs of many tests, so that one that was aborted starts no further test. */
  #run = 0;

  constructor(port: LatencyRunsPort) {
    this.#port = port;
  }

  /** The oldest first. */
  get ends(): ReadonlySignal<readonly LatencyTestEnd[]> {
    return this.#ends;
  }

  /** Whether one test follows another. */
  get continuous(): ReadonlySignal<boolean> {
    return this.#continuous;
  }

  /** Of the kept results, motion to photon, ms; `null` without one. */
  distribution(): Distribution | null {
    const window = new SampleWindow(MOST_ENDS);
    for (const { report } of this.#ends.peek()) if (report !== null) window.add(report.mtpMs);
    return window.distribution();
  }

  /** Runs one test. @returns whether a further test could have a result */
  async single(): Promise<boolean> {
    try {
      const report = await this.#port.test(this.#port.now());
      this.#keep({ atMs: this.#port.epochMs(), report, failure: null });
      return true;
    } catch (error) {
      if (!(error instanceof LatencyError)) throw error;
      const { reason } = error;
      // Another test, e.g. of the key L, ends by itself.
      if (reason === 'busy') return true;
      this.#keep({ atMs: this.#port.epochMs(), report: null, failure: reason });
      return reason === 'timeout';
    }
  }

  /** Tests until {@link abort}, or until a further test would fail as well. */
  start(): void {
    if (this.#continuous.peek()) return;
    this.#continuous.value = true;
    void this.#next(++this.#run);
  }

  /** Starts no further test. The one that runs still ends, and is kept. */
  abort(): void {
    this.#run++;
    this.#continuous.value = false;
  }

  async #next(run: number): Promise<void> {
    if (run !== this.#run) return;
    const goesOn = await this.single();
    if (run !== this.#run) return;
    if (goesOn) this.#port.after(PAUSE_MS, () => void this.#next(run));
    else this.abort();
  }

  #keep(end: LatencyTestEnd): void {
    this.#ends.value = [...this.#ends.peek().slice(1 - MOST_ENDS), end];
  }
}
