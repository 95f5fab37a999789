/**
 * An offer that has no answer after this time counts as lost, ms. Chosen: three of the page's requests
 * (resume-policy.ts).
 */
const ANSWER_WAIT_MS = 3000;
/**
 * Minimum time between an answered offer and the next, ms: ICE needs a moment to find a path. Chosen: several
 * round trips, and below the second in which the page asks again.
 */
const RESTART_SPACING_MS = 400;

/**
 * Decides when a request for an ICE restart gets an offer. Each offer gives up the path of the offer before it, so
 * offers must not overtake each other. The spacing also keeps the cost of endless requests low. Times are in ms on the
 * robot's clock.
 */
export class RestartPolicy {
  #offeredMs = Number.NEGATIVE_INFINITY;
  #answered = true;
  /** Requests that got no offer. */
  refused = 0;

  /** @returns whether to offer now; the offer then counts as made */
  request(nowMs: number): boolean {
    const waitMs = this.#answered ? RESTART_SPACING_MS : ANSWER_WAIT_MS;
    if (!(nowMs - this.#offeredMs >= waitMs)) {
      this.refused++;
      return false;
    }
    this.#offeredMs = nowMs;
    this.#answered = false;
    return true;
  }

  /** The operator has answered the latest offer. */
  onAnswer(): void {
    this.#answered = true;
  }
}
