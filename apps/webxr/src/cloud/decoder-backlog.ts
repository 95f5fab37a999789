/** What waited longer for the decoder shows the past, ms. */
const MOST_MS = 100;
/** What waited less is what comes now, ms. */
const CAUGHT_UP_MS = 20;

/**
 * Tells which packets are left out where they come faster than this machine decodes them: the browser would keep them all,
 * and show ever older ones. Once it is behind, the decoder leaves out all until it has caught up. So what it decodes is new,
 * and not always as old as is just allowed.
 */
export class DecoderBacklog {
  #behind = false;

  /** @param waitedMs from the packet's arrival until now; NaN where the browser does not tell: then none is left out */
  isStale(waitedMs: number): boolean {
    if (waitedMs > MOST_MS) this.#behind = true;
    else if (!(waitedMs > CAUGHT_UP_MS)) this.#behind = false;
    return this.#behind;
  }
}
