/** How long a place is kept for a driver whose session has ended, ms: time to reload the page or to change the network. */
const KEPT_MS = 15_000;
/** A driver's session counts as left behind once nothing was heard of it for this long, ms. */
const SILENT_MS = 2000;

/**
 * Keeps a place for who drives, so that a full robot admits its driver again: for a while after the driver's session has
 * ended, or in place of that session if nothing is heard from it any more. Operators are told apart by what they call
 * themselves, which proves nothing, so that this decides on a place and on nothing else. Pure: time is an argument.
 */
export class KeptPlace {
  /** What the operator of each session calls itself. */
  readonly #names = new Map<string, string>();
  #driver: string | null = null;
  #kept: { name: string; untilMs: number } | null = null;

  /** A session has been given a place. */
  requested(session: string, name: string): void {
    this.#names.set(session, name);
    if (this.#kept?.name === name) this.#kept = null;
  }

  /** Call it often. @param session the session that holds the lease; `null`: nobody drives, and the last one counts */
  drives(session: string | null): void {
    if (session === null || session === this.#driver) return;
    this.#driver = session;
    this.#kept = null;
  }

  /** A session has ended. */
  ended(session: string, nowMs: number): void {
    const name = this.#names.get(session);
    this.#names.delete(session);
    if (session !== this.#driver || name === undefined) return;
    this.#driver = null;
    this.#kept = { name, untilMs: nowMs + KEPT_MS };
  }

  /** How many places are kept from an operator of this name, 0 or 1. */
  keptFrom(name: string, nowMs: number): number {
    return this.#kept !== null && nowMs < this.#kept.untilMs && this.#kept.name !== name ? 1 : 0;
  }

  /**
   * The session that an operator of this name has left behind: it drove, and is silent.
   *
   * @param heardMs when a session was heard last
   */
  leftBehind(name: string, heardMs: (session: string) => number, nowMs: number): string | null {
    const driver = this.#driver;
    if (driver === null || this.#names.get(driver) !== name) return null;
    return nowMs - heardMs(driver) >= SILENT_MS ? driver : null;
  }
}
