/**
 * Whether a page can say that its cloud is painted by a video, so that the packets' own colours may be coarse. A claim is
 * made slowly and dropped at once. Time is an argument.
 */

/** A claim is made when so large a share of the clouds was painted, over so long, ms. */
const CLAIM_SHARE = 0.8;
export const CLAIM_OVER_MS = 2000;
/** It is dropped when the share is below this, over so long, ms … */
const DROP_SHARE = 0.4;
const DROP_OVER_MS = 1000;
/** … or no painted cloud has come for so long, ms. */
export const LOST_MS = 500;
/** A claim that lasted less may have been its own end: more and finer clouds leave a busy machine less time for videos. */
const SHORT_MS = 10_000;
/** Each such claim doubles the time until the next one, up to this, ms. */
export const MOST_WAIT_MS = 32_000;

export class PaintClaim {
  /** The clouds of the last {@link CLAIM_OVER_MS}. */
  #clouds: { atMs: number; painted: boolean }[] = [];
  #paintedMs = Number.NEGATIVE_INFINITY;
  /** Since when clouds are counted; `null`: they are not. */
  #sinceMs: number | null = null;
  #claimedMs: number | null = null;
  #waitMs = CLAIM_OVER_MS;

  get claimed(): boolean {
    return this.#claimedMs !== null;
  }

  /** A cloud was drawn until a newer one came. @param painted whether its picture came in time */
  add(painted: boolean, nowMs: number): void {
    this.#clouds.push({ atMs: nowMs, painted });
    if (painted) this.#paintedMs = nowMs;
  }

  /** @param possible whether videos can paint the cloud at all: one is watched, and the cloud is a surface in its colours */
  tick(possible: boolean, nowMs: number): void {
    if (!possible) {
      this.#end(nowMs);
      this.#sinceMs = null;
      return;
    }
    this.#sinceMs ??= nowMs;
    while (this.#clouds[0] !== undefined && nowMs - this.#clouds[0].atMs > CLAIM_OVER_MS)
      this.#clouds.shift();
    const lost = nowMs - this.#paintedMs > LOST_MS;
    if (this.claimed) {
      if (lost || this.#share(DROP_OVER_MS, nowMs) < DROP_SHARE) this.#end(nowMs);
    } else if (!lost && nowMs - this.#sinceMs >= this.#waitMs) {
      if (this.#share(CLAIM_OVER_MS, nowMs) >= CLAIM_SHARE) this.#claimedMs = nowMs;
    }
  }

  #end(nowMs: number): void {
    if (this.#claimedMs !== null) {
      const short = nowMs - this.#claimedMs < SHORT_MS;
      this.#waitMs = short ? Math.min(this.#waitMs * 2, MOST_WAIT_MS) : CLAIM_OVER_MS;
      this.#claimedMs = null;
      this.#sinceMs = nowMs;
    }
    this.#clouds = [];
  }

  #share(overMs: number, nowMs: number): number {
    const recent = this.#clouds.filter(({ atMs }) => nowMs - atMs <= overMs);
    return recent.length === 0 ? 0 : recent.filter(({ painted }) => painted).length / recent.length;
  }
}
