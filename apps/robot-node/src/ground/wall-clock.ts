/** The time of day, as in ROS stamps and in NTP times of RTP. */
import { monotonicMs, readAtOnce } from './clock.ts';

/**
 * Both clocks are read at once if no more than this passes meanwhile. Chosen: a tenth of the millisecond that
 * times of day are shown with.
 */
const AT_ONCE_MS = 0.1;

/**
 * The time of day with fractions of a millisecond: `Date.now()`, whose milliseconds are whole, and how far the monotonic
 * clock is into the millisecond. It follows a system clock that is set while the program runs, as on a robot that has no
 * battery-backed clock and hears the time from the network after it has started. (`performance.timeOrigin` stays what
 * the system clock said at the start.)
 */
export class WallClock {
  readonly #wholeMs: () => number;
  readonly #monotonicMs: () => number;
  #offsetMs = Number.NaN;

  /** @param wholeMs the system clock, whole ms since 1970, rounded down @param monotonic ms with fraction, of any origin */
  constructor(wholeMs: () => number, monotonic: () => number) {
    this.#wholeMs = wholeMs;
    this.#monotonicMs = monotonic;
  }

  /** What the system clock is ahead of the monotonic one, ms, accurate to a millisecond wherever both can be read at once. */
  get offsetMs(): number {
    const { beforeMs: monotonic, time: wholeMs } = readAtOnce(this.#monotonicMs, this.#wholeMs, AT_ONCE_MS);
    const told = monotonic + this.#offsetMs;
    if (!(told >= wholeMs)) this.#offsetMs = wholeMs - monotonic;
    else if (told > wholeMs + 1) this.#offsetMs = wholeMs + 1 - monotonic;
    return this.#offsetMs;
  }
}

const CLOCK = new WallClock(Date.now, monotonicMs);

/** Time of day, ns since 1970. */
export function wallNs(): bigint {
  return BigInt(Math.round((monotonicMs() + CLOCK.offsetMs) * 1e3)) * 1000n;
}

/** What must be added to {@link monotonicMs} now to get Unix time, ms. */
export function unixOffsetMs(): number {
  return CLOCK.offsetMs;
}
