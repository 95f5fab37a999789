/** Parts of the window, whose end is known to a tenth of it. */
const BUCKETS = 10;

/**
 * Measures how long a message waited in transit, without synchronised clocks. Arrival time minus the sender's timestamp
 * is the offset of the clocks, plus the fixed delay of the path, plus waiting. The smallest such difference of the last
 * seconds contains no waiting, so any excess over it is waiting.
 *
 * The minimum is kept only for a window, so that it follows clocks that drift (100 ppm is 1 ms in 10 s) and paths that
 * change. This has three consequences:
 * - After a timestamp from the future, or a clock that jumps back, everything looks late until the window has passed.
 * - A path that becomes permanently longer looks late for one window.
 * - A queue that stands for a whole window without ever draining is taken for part of the path.
 *
 * Silence is no evidence: the last minimum survives any pause, so that messages that were held back for longer than the
 * window do not pass as fresh.
 */
export class QueueingDelay {
  readonly #bucketMs: number;
  /** Minimum of each tenth of the window, as a ring; `Infinity` for a tenth without messages. */
  readonly #minima = new Float64Array(BUCKETS).fill(Number.POSITIVE_INFINITY);
  /** Number of the newest tenth, counted from time 0. */
  #newest: number | null = null;

  constructor(windowMs: number) {
    this.#bucketMs = windowMs / BUCKETS;
  }

  /**
   * Takes in one message.
   *
   * @param sentMs the sender's clock
   * @param receivedMs our clock
   * @returns how long it waited, ms, at least 0; `Infinity` if a time is not a finite number
   */
  observe(sentMs: number, receivedMs: number): number {
    const difference = receivedMs - sentMs;
    if (!Number.isFinite(difference)) return Number.POSITIVE_INFINITY;
    this.#advance(Math.floor(receivedMs / this.#bucketMs));
    const at = (this.#newest as number) % BUCKETS;
    this.#minima[at] = Math.min(this.#minima[at] as number, difference);
    return difference - this.#minimum();
  }

  #advance(bucket: number): void {
    const newest = this.#newest;
    if (newest === null) {
      this.#newest = Math.max(bucket, 0);
      return;
    }
    if (bucket <= newest) return;
    const carried = bucket - newest >= BUCKETS ? this.#minimum() : Number.POSITIVE_INFINITY;
    for (let b = Math.max(newest + 1, bucket - BUCKETS + 1); b <= bucket; b++) {
      this.#minima[b % BUCKETS] = Number.POSITIVE_INFINITY;
    }
    this.#minima[bucket % BUCKETS] = carried;
    this.#newest = bucket;
  }

  #minimum(): number {
    let minimum = Number.POSITIVE_INFINITY;
    for (const value of this.#minima) if (value < minimum) minimum = value;
    return minimum;
  }
}
