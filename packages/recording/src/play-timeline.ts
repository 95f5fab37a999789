export interface PlayClock {
  /** Time since any fixed start, ms. */
  now(): number;
  /** Ends early, without an error, when the signal is aborted. */
  wait(ms: number, signal: AbortSignal): Promise<void>;
}

/** If playing is further behind than this, it continues from the present position, ms. */
const LATE_MS = 500;

/** Computes when a recorded message is due. Pairs a moment of the clock with the recording's time at that moment. */
export class PlayTimeline {
  readonly #clock: PlayClock;
  readonly #rate: number;
  #anchor: { ms: number; ns: bigint } | null = null;

  /** @param rate 1 for the recorded speed, 2 for twice as fast */
  constructor(clock: PlayClock, rate: number) {
    this.#clock = clock;
    this.#rate = rate;
  }

  /** Whether anything was due since it was cleared. */
  get running(): boolean {
    return this.#anchor !== null;
  }

  /** The next message starts the timeline anew. */
  clear(): void {
    this.#anchor = null;
  }

  /** Sets this time of the recording as now. */
  begin(ns: bigint): void {
    this.#anchor = { ms: this.#clock.now(), ns };
  }

  /** Waits until this time is due; if playing is far behind, it becomes now. */
  async until(ns: bigint, signal: AbortSignal): Promise<void> {
    if (this.#anchor === null) this.begin(ns);
    const anchor = this.#anchor ?? { ms: 0, ns };
    const waitMs = anchor.ms + this.played(anchor.ns, ns) - this.#clock.now();
    if (waitMs > 0) await this.#clock.wait(waitMs, signal);
    else if (waitMs < -LATE_MS) this.begin(ns);
  }

  /** When this time was due, by the clock, ms; a time to come is now, because waiting may end slightly too early. */
  dueMs(ns: bigint): number {
    const now = this.#clock.now();
    const anchor = this.#anchor;
    return anchor === null ? now : Math.min(now, anchor.ms + this.played(anchor.ns, ns));
  }

  /** How long it takes to play from one time to another, ms. */
  played(fromNs: bigint, toNs: bigint): number {
    return Number(toNs - fromNs) / 1e6 / this.#rate;
  }
}
