/** Keeps the screen on while a robot is shown: a screen that goes dark would stop the drive. */
import { effect, type ReadonlySignal } from '@preact/signals-core';

/** The part of the browser's `WakeLockSentinel` that is used. */
export interface ScreenLock {
  release(): Promise<void>;
  addEventListener(type: 'release', listener: () => void): void;
}

/** Asks the browser for a lock; `null` in a browser that has none. */
type LockSource = (() => Promise<ScreenLock>) | null;

/** The browser takes a lock away when its tab is hidden, so it is asked for again when the tab is back. */
export class WakeLock {
  readonly #source: LockSource;
  #wanted = false;
  #asking = false;
  #lock: ScreenLock | null = null;

  constructor(source: LockSource) {
    this.#source = source;
  }

  get held(): boolean {
    return this.#lock !== null;
  }

  /** Whether the screen should stay on. */
  want(wanted: boolean): void {
    this.#wanted = wanted;
    void this.settle();
  }

  /** Asks for the lock or gives it back. Call it when the tab has become visible as well. Never rejects. */
  async settle(): Promise<void> {
    if (!this.#wanted) {
      const lock = this.#lock;
      this.#lock = null;
      await lock?.release().catch(() => {});
      return;
    }
    if (this.#lock !== null || this.#asking || this.#source === null) return;
    this.#asking = true;
    try {
      const lock = await this.#source();
      this.#lock = lock;
      lock.addEventListener('release', () => {
        if (this.#lock === lock) this.#lock = null;
      });
    } catch {
      // Refused: the battery is low, or the tab is hidden.
    } finally {
      this.#asking = false;
    }
    // It may have been given up meanwhile.
    if (!this.#wanted) await this.settle();
  }
}

/**
 * Keeps the screen on from now on, while both hold.
 *
 * @param live whether a robot is shown
 * @param wanted whether the operator wants it
 */
export function keepAwake(live: ReadonlySignal<boolean>, wanted: () => boolean): void {
  const lock = new WakeLock(browserLocks());
  effect(() => lock.want(live.value && wanted()));
  document.addEventListener('visibilitychange', () => {
    if (!document.hidden) void lock.settle();
  });
}

function browserLocks(): LockSource {
  const { wakeLock } = navigator as { wakeLock?: WakeLockManager };
  return wakeLock === undefined ? null : () => wakeLock.request('screen');
}

interface WakeLockManager {
  request(type: 'screen'): Promise<ScreenLock>;
}
