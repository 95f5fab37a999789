import { TokenBucket } from '@farpoint/timing';

/** Keeps others from filling the log: ten lines at once, then one a second. */
export class LimitedLines {
  readonly #bucket = new TokenBucket({ perSecond: 1, burst: 10 });
  #leftOut = 0;

  /** @returns how many lines were left out since the last; `null`: leave this one out, too */
  take(nowMs: number): number | null {
    if (!this.#bucket.take(nowMs)) {
      this.#leftOut++;
      return null;
    }
    const leftOut = this.#leftOut;
    this.#leftOut = 0;
    return leftOut;
  }
}
