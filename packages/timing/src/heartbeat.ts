export interface HeartbeatOptions {
  /** How long the first sign of life may take, ms. */
  readonly firstMs: number;
  /** How long it may be silent after that, ms. */
  readonly silenceMs: number;
  /** How often {@link Heartbeat.isLost} is called, ms. */
  readonly checkMs: number;
}

/**
 * Notices that something no longer gives signs of life: it hangs. Time in which whoever checks has hung itself does not
 * count, because signs of life may be waiting to be read.
 */
export class Heartbeat {
  readonly #options: HeartbeatOptions;
  #checkedMs: number;
  #silentMs = 0;
  #limitMs: number;

  /** @param nowMs of a monotonic clock */
  constructor(options: HeartbeatOptions, nowMs: number) {
    this.#options = options;
    this.#checkedMs = nowMs;
    this.#limitMs = options.firstMs;
  }

  /** There was a sign of life. */
  beat(): void {
    this.#silentMs = 0;
    this.#limitMs = this.#options.silenceMs;
  }

  /** Whether it has been silent for too long. @param nowMs of the same clock */
  isLost(nowMs: number): boolean {
    const { checkMs } = this.#options;
    this.#silentMs += Math.min(Math.max(nowMs - this.#checkedMs, 0), 2 * checkMs);
    this.#checkedMs = nowMs;
    return this.#silentMs > this.#limitMs;
  }

  /** How long it has been silent, without such times, ms. */
  get silentMs(): number {
    return this.#silentMs;
  }
}
