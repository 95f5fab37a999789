import { type Addon, loadAddon, type WatchHandle } from './addon.ts';
import type { MappedFile } from './mapped-file.ts';

export type WatchOutcome =
  /** The value has changed. */
  | 'changed'
  /** It is still the same when the time is over. */
  | 'timeout'
  /** The file was truncated. */
  | 'fault';
const OUTCOMES: readonly WatchOutcome[] = ['changed', 'timeout', 'fault'];

export interface WatchOrder {
  /** Reports when the byte or word differs from this. */
  value: number;
  /** Without a futex: checks once, then waits for this long before polling, ms. Default 0. */
  quietMs?: number;
  /** Without a futex: polling interval, ms. Default 1. */
  pollMs?: number;
  timeoutMs: number;
}

/** A native thread that waits for a byte or word of a mapped file to change. It waits for one change at a time. */
export class Watch implements Disposable {
  readonly #addon: Addon;
  readonly #handle: WatchHandle;
  #closed = false;

  /**
   * @param where a word that its writer wakes (`futex`), or a byte
   * @param onOutcome called once after each {@link arm}; never after {@link close}
   */
  constructor(
    file: MappedFile,
    where: { offset: number; futex: boolean },
    onOutcome: (outcome: WatchOutcome) => void,
  ) {
    this.#addon = loadAddon();
    this.#handle = this.#addon.watch(file.handle, where.offset, where.futex, (outcome) => {
      if (!this.#closed) onOutcome(OUTCOMES[outcome] as WatchOutcome);
    });
  }

  /** Waits for the next change. Does nothing while it is already waiting. */
  arm({ value, quietMs = 0, pollMs = 1, timeoutMs }: WatchOrder): void {
    if (this.#closed) return;
    this.#addon.arm(this.#handle, value, Math.round(quietMs * 1000), Math.round(pollMs * 1000), timeoutMs);
  }

  close(): void {
    if (this.#closed) return;
    this.#closed = true;
    this.#addon.unwatch(this.#handle);
  }

  [Symbol.dispose](): void {
    this.close();
  }
}
