/** How long a relay's allocation lasts, and how often it is refreshed, whatever the TURN server says (RFC 8656 §7). */

/** What werift asks for, and servers grant unless configured otherwise, s. */
const USUAL_S = 600;
const MIN_S = 60;
/** A server that grants more is asked again after an hour. */
const MAX_S = 3600;

/**
 * The lifetime to go by. A refresh is due after five sixths of it. Without a bound, a lifetime of 0 s, none at all, or
 * one beyond what timers can wait for would have the robot ask again without a pause.
 *
 * @param toldS the LIFETIME attribute, seconds; anything else if the server left it out
 */
export function soundLifetimeS(toldS: unknown): number {
  if (typeof toldS !== 'number' || !Number.isFinite(toldS)) return USUAL_S;
  return Math.min(Math.max(toldS, MIN_S), MAX_S);
}

/** Time between two refreshes of an allocation, ms: also after one that failed, or was due at once. */
export const REFRESH_INTERVAL_MS = 10_000;

/** Spaces the refreshes of one allocation. */
export class RefreshPace {
  #nextMs: number;

  /** @param nowMs when the allocation was made, on a monotonic clock */
  constructor(nowMs: number) {
    this.#nextMs = nowMs + REFRESH_INTERVAL_MS;
  }

  /** How long the next refresh must wait, ms. */
  take(nowMs: number): number {
    const waitMs = Math.max(0, this.#nextMs - nowMs);
    this.#nextMs = nowMs + waitMs + REFRESH_INTERVAL_MS;
    return waitMs;
  }
}
