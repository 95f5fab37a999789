/** An offer that is not answered by then was lost, ms. */
export const ANSWER_WAIT_MS = 3000;
/** From one offer to the next at least, ms: a path needs a moment to be found. */
export const RESTART_SPACING_MS = 400;

/**
 * When an operator who asks for an ICE restart gets an offer. Each offer gives up the path of the last one, so they must not
 * overtake each other, and whoever asks without end costs little. Robot's clock, ms.
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
