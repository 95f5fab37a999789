/** What waited so much longer than the least that ever waited shows the past, ms. */
const MOST_MS = 100;
/** What waited only so much longer is what comes now, ms. */
const CAUGHT_UP_MS = 20;

/**
 * Tells which packets are left out where they come faster than this machine decodes them: the browser would keep them all,
 * and show ever older ones. Once it is behind, the decoder leaves out all until it has caught up. So what it decodes is new,
 * and not always as old as is just allowed.
 */
export class DecoderBacklog {
  #behind = false;
  #leastMs = Number.POSITIVE_INFINITY;

  /**
   * @param waitedMs from the packet's arrival until now, but for what a browser's clocks of the two are apart; NaN where it
   *   does not tell: then none is left out
   */
  isStale(waitedMs: number): boolean {
    if (waitedMs < this.#leastMs) this.#leastMs = waitedMs;
    const behindMs = waitedMs - this.#leastMs;
    if (behindMs > MOST_MS) this.#behind = true;
    else if (!(behindMs > CAUGHT_UP_MS)) this.#behind = false;
    return this.#behind;
  }
}
