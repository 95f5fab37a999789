const BUCKETS = 10;

/**
 * How long a message waited on its way, without synchronised clocks: arrival minus the sender's stamp is the clocks'
 * offset, plus the path's fixed delay, plus waiting. The smallest such difference of the last seconds holds no waiting,
 * so what exceeds it is waiting.
 *
 * The minimum is kept for a window only, so that it follows clocks that drift (100 ppm is 1 ms in 10 s) and paths that
 * change. Three consequences:
 * - A stamp from the future, or a clock that jumps back, makes everything after it look late until the window has
 *   passed; then it is right again.
 * - A path that becomes longer for good looks late for one window.
 * - A queue that stands for a whole window without ever draining is taken for the path.
 *
 * Silence is no evidence: the last minimum outlives any pause, so that messages which were held back for longer than the
 * window do not pass for fresh.
 */
export class QueueingDelay {
  readonly #bucketMs: number;
  /** Minimum of each tenth of the window, a ring; `Infinity` where nothing came. */
  readonly #minima = new Float64Array(BUCKETS).fill(Number.POSITIVE_INFINITY);
  /** Number of the newest tenth since time 0. */
  #newest: number | null = null;

  constructor(windowMs: number) {
    this.#bucketMs = windowMs / BUCKETS;
  }

  /**
   * Takes one message in.
   *
   * @param sentMs the sender's clock
   * @param receivedMs our clock
   * @returns how long it waited, ms, at least 0; `Infinity` where a time is not a finite number
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
