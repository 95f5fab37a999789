import { computed, type ReadonlySignal, signal } from '@preact/signals-core';

/**
 * How long the release control must be held, ms. Chosen: nobody holds it by mistake (docs/headset.md);
 * release-hold.test.ts holds it.
 */
export const RELEASE_HOLD_MS = 1000;
/**
 * The most that one `advance` counts for, ms: a page that hung cannot know whether the operator let go.
 * Chosen: as long as a hand counts as read (READING_HOLDS_MS of the operator package).
 */
const MOST_COUNTED_MS = 100;

export type ReleaseControl = 'pointer' | 'key' | 'gamepad' | 'headset';

/**
 * Releases the emergency stop once one control has been held for a second. The press must come after the stop:
 * neither a single press nor a hand that was already holding on can release it. Pure: time is an argument, ms.
 */
export class ReleaseHold {
  readonly #down = new Set<ReleaseControl>();
  /** The control being held, from its first `advance`. */
  #by: ReleaseControl | null = null;
  readonly #heldMs = signal(0);
  #advancedMs = 0;
  /** Set until every control has been let go; nothing counts meanwhile. */
  #spent = false;

  /** From 0 (nothing is held) to 1 (releases). */
  readonly progress: ReadonlySignal<number> = computed(() => this.#heldMs.value / RELEASE_HOLD_MS);

  /** @returns whether it has just been pressed */
  set(control: ReleaseControl, down: boolean): boolean {
    const isNew = down && !this.#down.has(control);
    if (down) this.#down.add(control);
    else this.#down.delete(control);
    return isNew;
  }

  /** The operator pressed stop: a control that is held now does not release it. */
  cancel(): void {
    this.#spent = true;
    this.#restart(null);
  }

  /** Call this when the page no longer receives events. Controls that are polled report their own release. */
  letGo(): void {
    this.#down.delete('pointer');
    this.#down.delete('key');
    this.cancel();
  }

  /** Counts how long a control is held. Call this many times a second. @returns whether to release now */
  advance(nowMs: number, latched: boolean): boolean {
    const passedMs = Math.min(nowMs - this.#advancedMs, MOST_COUNTED_MS);
    this.#advancedMs = nowMs;
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
