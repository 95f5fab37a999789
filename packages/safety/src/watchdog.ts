/**
 * Expires if it is not fed in time. It owns no timer: `deadlineMs` says when to check again, and checking late or often
 * changes nothing.
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

  /** Returns to the state before the first feeding. */
  reset(): void {
    this.#fedMs = null;
  }

  /** When it expires unless it is fed before; `null` if it was never fed. */
  get deadlineMs(): number | null {
    return this.#fedMs === null ? null : this.#fedMs + this.#timeMs;
  }

  /** Also true if it was never fed, and for a time that is NaN: whatever is not certainly fresh has expired. */
  expired(nowMs: number): boolean {
    return !(this.#fedMs !== null && nowMs - this.#fedMs < this.#timeMs);
  }
}
