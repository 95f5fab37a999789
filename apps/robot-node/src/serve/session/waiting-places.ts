/**
 * How long an operator may take to answer while nobody else needs its place, ms. Chosen: several round trips
 * of a bad link.
 */
const ANSWER_MS = 1000;
/** The same for the connection after the answer: checks of slow relays take seconds, ms. */
const CONNECT_MS = 8000;

interface Waiting {
  sinceMs: number;
  answered: boolean;
}

/**
 * The sessions that are not connected yet. Each holds a place of the robot, although nobody may be there. When all places
 * are taken, one that has waited for too long gives way to a new request.
 */
export class WaitingPlaces {
  readonly #waiting = new Map<string, Waiting>();

  requested(session: string, nowMs: number): void {
    this.#waiting.set(session, { sinceMs: nowMs, answered: false });
  }

  answered(session: string): void {
    const waiting = this.#waiting.get(session);
    if (waiting !== undefined) waiting.answered = true;
  }

  /** It is connected or has ended. */
  settled(session: string): void {
    this.#waiting.delete(session);
  }

  /** @returns the session that gives way: the one that is overdue for longest; `null` if none is */
  overdue(nowMs: number): string | null {
    let found: string | null = null;
    let most = 0;
    for (const [session, { sinceMs, answered }] of this.#waiting) {
      const overdueMs = nowMs - sinceMs - (answered ? CONNECT_MS : ANSWER_MS);
      if (overdueMs < most) continue;
      most = overdueMs;
      found = session;
    }
    return found;
  }
}
