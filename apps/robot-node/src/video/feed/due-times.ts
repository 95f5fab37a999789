/**
 * When each of several periodic things is due: at k/rate seconds, k = 0, 1, 2, …, counted from the clock's zero. Time is
 * an argument.
 *
 * Instants are computed from k, not from an interval in whole nanoseconds: its rounding would add up over a machine's
 * uptime, at 30/s to 1 ms a day.
 */
const NS_PER_S = 1_000_000_000n;
/** Rates are kept as fractions of this denominator: 29.97/s is one of them. */
const RATE_PARTS = 1000;

interface Due {
  /** Thousandths of 1/s. */
  readonly rate: bigint;
  /** The next instant's number. */
  next: bigint;
}

export class DueTimes<T> {
  readonly #due = new Map<T, Due>();

  /**
   * Due first at the next of its instants.
   *
   * @param perSecond 0.001 or more
   */
  add(item: T, perSecond: number, nowNs: bigint): void {
    const rate = BigInt(Math.round(perSecond * RATE_PARTS));
    this.#due.set(item, { rate, next: newest(rate, nowNs) + 1n });
  }

  delete(item: T): void {
    this.#due.delete(item);
  }

  /** The next of all instants; `null` if there is none. */
  get next(): bigint | null {
    let next: bigint | null = null;
    for (const due of this.#due.values()) {
      const atNs = instant(due.rate, due.next);
      if (next === null || atNs < next) next = atNs;
    }
    return next;
  }

  /** What is due, each with its newest instant: those that were missed do not come back. */
  take(nowNs: bigint): { item: T; atNs: bigint }[] {
    const taken: { item: T; atNs: bigint }[] = [];
    for (const [item, due] of this.#due) {
      const last = newest(due.rate, nowNs);
      if (last < due.next) continue;
      due.next = last + 1n;
      taken.push({ item, atNs: instant(due.rate, last) });
    }
    return taken;
  }
}

/** The first whole nanosecond that is not before it. */
function instant(rate: bigint, number: bigint): bigint {
  return (number * NS_PER_S * BigInt(RATE_PARTS) + rate - 1n) / rate;
}

/** The number of the last instant that has come. */
function newest(rate: bigint, nowNs: bigint): bigint {
  return (nowNs * rate) / (NS_PER_S * BigInt(RATE_PARTS));
}
