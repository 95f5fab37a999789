/** A finger that is held still on the view. Pure: whoever calls it keeps the time. */

/** A finger that is held for so long points, ms. Chosen: as systems have it; long-press.test.ts holds it. */
export const LONG_PRESS_MS = 500;
/** Within this a finger counts as still, pixels. Chosen: a fingertip rolls so far; long-press.test.ts holds it. */
const STILL_PX = 10;

export class LongPress {
  /** All fingers that are down. */
  readonly #down = new Set<number>();
  #waiting: { readonly id: number; readonly x: number; readonly y: number } | null = null;

  /** Whether a finger may yet be held for long enough. */
  get waits(): boolean {
    return this.#waiting !== null;
  }

  /** A second finger zooms: neither points then. */
  down(id: number, x: number, y: number): void {
    this.#down.add(id);
    this.#waiting = this.#down.size === 1 ? { id, x, y } : null;
  }

  move(id: number, x: number, y: number): void {
    const finger = this.#waiting;
    if (finger?.id === id && Math.hypot(x - finger.x, y - finger.y) > STILL_PX) this.#waiting = null;
  }

  /** It is let go, or the system has taken it. */
  up(id: number): void {
    this.#down.delete(id);
    if (this.#waiting?.id === id) this.#waiting = null;
  }

  /** The time is over. @returns the finger that was held; `null` if none was */
  take(): number | null {
    const held = this.#waiting?.id ?? null;
    this.#waiting = null;
    return held;
  }
}
