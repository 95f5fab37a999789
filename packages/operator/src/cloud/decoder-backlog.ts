/**
 * A packet that waited this much longer than the shortest wait so far is stale, ms. Chosen: three frames at
 * 30 a second; decoder-backlog.test.ts holds it.
 */
const MOST_MS = 100;
/** A packet that waited at most this much longer is fresh: the decoder has caught up, ms. */
const CAUGHT_UP_MS = 20;

/**
 * Decides which packets to drop when they arrive faster than this machine decodes them. The browser would queue them
 * all, and the page would show ever older ones. Once behind, the decoder drops everything until it has caught up. The
 * packets that it decodes are then fresh, rather than always just within the limit.
 */
export class DecoderBacklog {
  #behind = false;
  #leastMs = Number.POSITIVE_INFINITY;
  #waitedMs = 0;

  /** How much longer than the shortest wait so far the last packet waited, ms; 0 if the browser does not say. */
  get waitedMs(): number {
    return this.#waitedMs;
  }

  /**
   * Whether to drop a packet.
   *
   * @param waitedMs time since the packet's arrival, up to a constant offset between the browser's clocks; NaN if the
   *   browser does not provide it, in which case nothing is dropped
   */
  isStale(waitedMs: number): boolean {
    if (waitedMs < this.#leastMs) this.#leastMs = waitedMs;
    const behindMs = waitedMs - this.#leastMs;
    this.#waitedMs = Number.isFinite(behindMs) ? behindMs : 0;
    if (behindMs > MOST_MS) this.#behind = true;
    else if (!(behindMs > CAUGHT_UP_MS)) this.#behind = false;
    return this.#behind;
  }
}
