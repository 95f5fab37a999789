/** Earliest first; first in, first out among equal times. */
export class TimeHeap<T> {
  readonly #times: number[] = [];
  readonly #orders: number[] = [];
  readonly #items: T[] = [];
  #order = 0;

  get length(): number {
    return this.#times.length;
  }

  /** The earliest item's time; Infinity if there is none. */
  get headMs(): number {
    return this.#times[0] ?? Number.POSITIVE_INFINITY;
  }

  push(timeMs: number, item: T): void {
    let at = this.#times.length;
    const order = this.#order++;
    while (at > 0) {
      const parent = (at - 1) >> 1;
      if (this.#times[parent]! <= timeMs) break;
      this.#put(at, this.#times[parent]!, this.#orders[parent]!, this.#items[parent]!);
      at = parent;
    }
    this.#put(at, timeMs, order, item);
  }

  /** Removes the earliest item; there must be one. */
  shift(): T {
    const head = this.#items[0]!;
    const time = this.#times.pop()!;
    const order = this.#orders.pop()!;
    const item = this.#items.pop()!;
    const length = this.#times.length;
    if (length === 0) return head;
    let at = 0;
    for (;;) {
      let child = 2 * at + 1;
      if (child >= length) break;
      if (child + 1 < length && this.#before(child + 1, this.#times[child]!, this.#orders[child]!)) child++;
      if (!this.#before(child, time, order)) break;
      this.#put(at, this.#times[child]!, this.#orders[child]!, this.#items[child]!);
      at = child;
    }
    this.#put(at, time, order, item);
    return head;
  }

  #before(at: number, time: number, order: number): boolean {
    const own = this.#times[at]!;
    return own < time || (own === time && this.#orders[at]! < order);
  }

  #put(at: number, time: number, order: number, item: T): void {
    this.#times[at] = time;
    this.#orders[at] = order;
    this.#items[at] = item;
  }
}
