/** Remembers that another operator has taken over from this one, for as long as this one's hand holds on. */
import type { LeaseState } from '@farpoint/protocol';

export class Takeover {
  #held = false;
  #by: string | null = null;

  /**
   * The robot has told who drives.
   *
   * @param driver its name, by its grant
   * @returns whether another has just taken over from this operator
   */
  onLease(holder: LeaseState['holder'], driver: string | null): boolean {
    const taken = this.#held && holder === 'other';
    this.#held = holder === 'you';
    if (taken) this.#by = driver ?? '';
    else if (holder !== 'other') this.#by = null;
    return taken;
  }

  /** A session begins or ends. */
  reset(): void {
    this.#held = false;
    this.#by = null;
  }

  /** Who took over from a hand that still holds on, '' without a name; `null`: nobody did. @param gripped whether it does */
  by(gripped: boolean): string | null {
    if (!gripped) this.#by = null;
    return this.#by;
  }
}
