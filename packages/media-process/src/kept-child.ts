/** A media program that is started again when it ends. */
import { Backoff, MEDIA_RETRY, MEDIA_SUCCESS_MS } from '@farpoint/timing';

export interface Retry {
  readonly firstMs: number;
  readonly mostMs: number;
}

/** What is started: one run of the program. */
export interface Child {
  close(): Promise<void>;
}

/** Starts a child, and another one after a wait that grows with each failure. */
export class KeptChild<T extends Child> {
  /** The present one; `null` while there is none. */
  child: T | null = null;
  /** How often one was started. */
  starts = 0;
  readonly #start: () => T;
  readonly #backoff: Backoff;
  #timer: NodeJS.Timeout | null = null;
  #startedMs = 0;
  #closed = false;

  constructor(start: () => T, retry: Retry = MEDIA_RETRY, random: () => number = Math.random) {
    this.#start = start;
    this.#backoff = new Backoff({ ...retry, random });
  }

  start(): void {
    this.#timer = null;
    if (this.#closed) return;
    this.starts++;
    this.#startedMs = performance.now();
    this.child = this.#start();
  }

  /**
   * The child has ended.
   *
   * @param retried whether another one is started
   * @returns whether that matters: not after `close`
   */
  onEnd(retried: boolean): boolean {
    this.child = null;
    if (this.#closed) return false;
    if (performance.now() - this.#startedMs > MEDIA_SUCCESS_MS) this.#backoff.reset();
    if (retried) this.#timer = setTimeout(() => this.start(), this.#backoff.nextMs());
    return true;
  }

  /** Resolves when the process is gone. */
  async close(): Promise<void> {
    this.#closed = true;
    if (this.#timer !== null) clearTimeout(this.#timer);
    await this.child?.close();
  }
}
