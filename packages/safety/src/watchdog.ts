/**
 * Runs out when it has not been fed for its time. It owns no timer: `deadlineMs` says when to look again, and looking
 * late or often changes nothing.
 */
export class Watchdog {
  readonly #timeMs: number;
  #fedMs: number | null = null;

  constructor(timeMs: number) {
    this.#timeMs = timeMs;
  }

  feed(nowMs: number): void {
    this.#fedMs = nowMs;
  }

  /** As if never fed. */
  reset(): void {
    this.#fedMs = null;
  }

  /** When it runs out if it is not fed before; `null` where it was never fed. */
  get deadlineMs(): number | null {
    return this.#fedMs === null ? null : this.#fedMs + this.#timeMs;
  }

  /** True also where it was never fed, and for a time that is no number: what is not surely fresh has expired. */
  expired(nowMs: number): boolean {
    return !(this.#fedMs !== null && nowMs - this.#fedMs < this.#timeMs);
  }
}
