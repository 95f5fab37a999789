/** When each of several periodic things is due, at multiples of its own interval. Time is an argument. */
export class DueTimes<T> {
  readonly #next = new Map<T, { intervalNs: bigint; dueNs: bigint }>();

  /** Due first at the next multiple of the interval. */
  add(item: T, intervalNs: bigint, nowNs: bigint): void {
    this.#next.set(item, { intervalNs, dueNs: (nowNs / intervalNs + 1n) * intervalNs });
  }

  delete(item: T): void {
    this.#next.delete(item);
  }

  /** The next of all instants; `null` if there is none. */
  get next(): bigint | null {
    let next: bigint | null = null;
    for (const { dueNs } of this.#next.values()) if (next === null || dueNs < next) next = dueNs;
    return next;
  }

  /** What is due, each with its newest instant: those that were missed do not come back. */
  take(nowNs: bigint): { item: T; atNs: bigint }[] {
    const due: { item: T; atNs: bigint }[] = [];
    for (const [item, times] of this.#next) {
      if (times.dueNs > nowNs) continue;
      const atNs = (nowNs / times.intervalNs) * times.intervalNs;
      times.dueNs = atNs + times.intervalNs;
      due.push({ item, atNs });
    }
    return due;
  }
}
