import { computed, type ReadonlySignal, signal } from '@preact/signals-core';

/** How long the release control is held, ms. */
export const RELEASE_HOLD_MS = 1000;
/** What one tick counts for at most, ms: a page that hung has not seen whether the hand let go. */
const MOST_TICK_MS = 100;

export type ReleaseControl = 'pointer' | 'key' | 'gamepad' | 'headset';

/**
 * Releasing the emergency stop takes one control held for a second, from a press that came after the stop: no single press,
 * and no hand that held on, ever releases. Pure: time is an argument, ms.
 */
export class ReleaseHold {
  readonly #down = new Set<ReleaseControl>();
  /** The control that counts, from its first tick. */
  #by: ReleaseControl | null = null;
  readonly #heldMs = signal(0);
  #tickMs = 0;
  /** Nothing counts until every control was let go. */
  #spent = false;

  /** 0 where nothing is held, 1 when it releases. */
  readonly progress: ReadonlySignal<number> = computed(() => this.#heldMs.value / RELEASE_HOLD_MS);

  set(control: ReleaseControl, down: boolean): void {
    if (down) this.#down.add(control);
    else this.#down.delete(control);
  }

  /** Stop was pressed: what is held now does not release it. */
  cancel(): void {
    this.#spent = true;
    this.#restart(null);
  }

  /** The page does not see its controls any more. What is polled tells by itself when it is let go. */
  letGo(): void {
    this.#down.delete('pointer');
    this.#down.delete('key');
    this.cancel();
  }

  /** Call many times a second. @returns whether to release now */
  tick(nowMs: number, latched: boolean): boolean {
    const passedMs = Math.min(nowMs - this.#tickMs, MOST_TICK_MS);
    this.#tickMs = nowMs;
    const [first] = this.#down;
    if (first === undefined) {
      this.#spent = false;
      this.#restart(null);
      return false;
    }
    if (!latched || (this.#by !== null && !this.#down.has(this.#by))) this.cancel();
    if (this.#spent) return false;
    if (this.#by === null) {
      this.#restart(first);
      return false;
    }
    this.#heldMs.value += passedMs;
    if (this.#heldMs.value < RELEASE_HOLD_MS) return false;
    this.cancel();
    return true;
  }

  #restart(by: ReleaseControl | null): void {
    this.#by = by;
    this.#heldMs.value = 0;
  }
}
