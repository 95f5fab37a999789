/** Runs latency tests, one or many after another, and keeps what they measured. Time is passed in. */
import { LatencyError, type LatencyFailure, type LatencyReport } from '@farpoint/operator';
import { type ReadonlySignal, signal } from '@preact/signals-core';
import { type TestStages, testStages } from './test-stages.ts';

/** A test that ended. */
export interface LatencyEntry {
  /** When it ended, ms since the epoch. */
  readonly atMs: number;
  /** `null` if it failed. */
  readonly report: LatencyReport | null;
  readonly failure: LatencyFailure | null;
  /** `null` if they cannot be told. */
  readonly stages: TestStages | null;
}

export interface LatencyLogPort {
  /** @param startedAtMs page's clock, ms */
  test(startedAtMs: number): Promise<LatencyReport>;
  /** Robot's clock minus page's clock, ms. */
  offsetMs(): number | null;
  /** Page's clock, ms. */
  now(): number;
  /** Milliseconds since the epoch. */
  epochMs(): number;
  /** Calls back after this time, ms. */
  after(ms: number, act: () => void): void;
}

/** From the end of one test to the next: the robot answers at most a few a second. */
export const PAUSE_MS = 500;
export const MOST_ENTRIES = 5000;
/** After these a further test would fail as well. */
const FINAL: readonly LatencyFailure[] = ['no-session', 'no-lease'];

export class LatencyLog {
  readonly #port: LatencyLogPort;
  readonly #entries = signal<readonly LatencyEntry[]>([]);
  readonly #continuous = signal(false);
  /** Numbers the runs of many tests, so that one that was ended starts no further test. */
  #run = 0;

  constructor(port: LatencyLogPort) {
    this.#port = port;
  }

  /** The oldest first. */
  get entries(): ReadonlySignal<readonly LatencyEntry[]> {
    return this.#entries;
  }

  /** Whether one test follows another. */
  get continuous(): ReadonlySignal<boolean> {
    return this.#continuous;
  }

  /** @throws {LatencyError} if the test has no result */
  async once(startedAtMs: number): Promise<LatencyReport> {
    try {
      const report = await this.#port.test(startedAtMs);
      this.#keep({ report, failure: null, stages: testStages(report, this.#port.offsetMs()) });
      return report;
    } catch (error) {
      if (error instanceof LatencyError && error.reason !== 'busy')
        this.#keep({ report: null, failure: error.reason, stages: null });
      throw error;
    }
  }

  /** Tests until {@link abort}, or until a further test would fail as well. */
  start(): void {
    if (this.#continuous.peek()) return;
    this.#continuous.value = true;
    void this.#next(++this.#run);
  }

  /** The test that runs still ends, and is kept. */
  abort(): void {
    this.#run++;
    this.#continuous.value = false;
  }

  async #next(run: number): Promise<void> {
    if (run !== this.#run) return;
    try {
      await this.once(this.#port.now());
    } catch (error) {
      if (!(error instanceof LatencyError)) throw error;
      if (run === this.#run && FINAL.includes(error.reason)) this.abort();
    }
    this.#port.after(PAUSE_MS, () => void this.#next(run));
  }

  #keep(entry: Omit<LatencyEntry, 'atMs'>): void {
    const kept = this.#entries.peek().slice(-(MOST_ENTRIES - 1));
    this.#entries.value = [...kept, { atMs: this.#port.epochMs(), ...entry }];
  }
}
