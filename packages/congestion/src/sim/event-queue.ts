/** Virtual time: what is scheduled runs in the order of its time, and of scheduling where times are equal. */
export class EventQueue {
  nowMs = 0;
  readonly #times: number[] = [];
  readonly #orders: number[] = [];
  readonly #actions: (() => void)[] = [];
  #order = 0;

  at(timeMs: number, action: () => void): void {
    let i = this.#times.length;
    const time = Math.max(timeMs, this.nowMs);
    const order = this.#order++;
    this.#times.push(time);
    this.#orders.push(order);
    this.#actions.push(action);
    while (i > 0) {
      const parent = (i - 1) >> 1;
      if ((this.#times[parent] as number) <= time) break;
      this.#move(parent, i);
      i = parent;
    }
    this.#put(i, time, order, action);
  }

  /** Runs everything up to and including this time. */
  runUntil(timeMs: number): void {
    while (this.#times.length > 0 && (this.#times[0] as number) <= timeMs) {
      this.nowMs = this.#times[0] as number;
      this.#pop()();
    }
    this.nowMs = timeMs;
  }

  #pop(): () => void {
    const action = this.#actions[0] as () => void;
    const time = this.#times.pop() as number;
    const order = this.#orders.pop() as number;
    const last = this.#actions.pop() as () => void;
    const length = this.#times.length;
    if (length === 0) return action;
    let i = 0;
    for (;;) {
      let child = 2 * i + 1;
      if (child >= length) break;
      if (child + 1 < length && this.#before(child + 1, child)) child++;
      const childTime = this.#times[child] as number;
      if (time < childTime || (time === childTime && order < (this.#orders[child] as number))) break;
      this.#move(child, i);
      i = child;
    }
    this.#put(i, time, order, last);
    return action;
  }

  #before(a: number, b: number): boolean {
    const ta = this.#times[a] as number;
    const tb = this.#times[b] as number;
    return ta < tb || (ta === tb && (this.#orders[a] as number) < (this.#orders[b] as number));
  }

  #move(from: number, to: number): void {
    this.#put(
      to,
      this.#times[from] as number,
      this.#orders[from] as number,
      this.#actions[from] as () => void,
    );
  }

  #put(at: number, time: number, order: number, action: () => void): void {
    this.#times[at] = time;
    this.#orders[at] = order;
    this.#actions[at] = action;
  }
}
