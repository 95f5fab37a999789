export interface PlayClock {
  /** Any fixed beginning, ms. */
  now(): number;
  /** Ends early, without an error, when the signal is aborted. */
  wait(ms: number, signal: AbortSignal): Promise<void>;
}

/** More behind than this, it goes on from where it is, ms. */
const LATE_MS = 500;

/** When what was recorded is due: a moment of the clock, and the time of the recording at it. */
export class PlayTimeline {
  readonly #clock: PlayClock;
  readonly #rate: number;
  #anchor: { ms: number; ns: bigint } | null = null;

  /** @param rate 1 as it was recorded, 2 twice as fast */
  constructor(clock: PlayClock, rate: number) {
    this.#clock = clock;
    this.#rate = rate;
  }

  /** Whether anything was due since it was cleared. */
  get running(): boolean {
    return this.#anchor !== null;
  }

  /** Whatever is next begins it anew. */
  clear(): void {
    this.#anchor = null;
  }

  /** This is now. */
  begin(ns: bigint): void {
    this.#anchor = { ms: this.#clock.now(), ns };
  }

  /** Waits until that is due; what is far behind is now. */
  async until(ns: bigint, signal: AbortSignal): Promise<void> {
    if (this.#anchor === null) this.begin(ns);
    const anchor = this.#anchor ?? { ms: 0, ns };
    const waitMs = anchor.ms + this.played(anchor.ns, ns) - this.#clock.now();
    if (waitMs > 0) await this.#clock.wait(waitMs, signal);
    else if (waitMs < -LATE_MS) this.begin(ns);
  }

  /** How long it takes to play from one time to another, ms. */
  played(fromNs: bigint, toNs: bigint): number {
    return Number(toNs - fromNs) / 1e6 / this.#rate;
  }
}
