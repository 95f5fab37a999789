/** What the robot was told, and when. Bounded memory; times are the operator's clock, ms. */

/** Changes that are kept: a stick that never rests changes 40 times a second. */
const CAPACITY = 1024;

export class CommandHistory {
  readonly #times = new Float64Array(CAPACITY);
  readonly #linear = new Float64Array(CAPACITY);
  readonly #angular = new Float64Array(CAPACITY);
  readonly #lateral = new Float64Array(CAPACITY);
  readonly #watchdogMs: () => number;
  #first = 0;
  #length = 0;
  #forgets = false;
  #sentMs = Number.NEGATIVE_INFINITY;
  /** A wish that no command has carried yet. */
  #wishMs = Number.POSITIVE_INFINITY;
  #wishLinear = 0;
  #wishAngular = 0;
  #wishLateral = 0;

  /** @param watchdogMs without a command for this long, the robot brakes */
  constructor(watchdogMs: () => number) {
    this.#watchdogMs = watchdogMs;
  }

  clear(): void {
    this.#first = 0;
    this.#length = 0;
    this.#forgets = false;
    this.#sentMs = Number.NEGATIVE_INFINITY;
    this.#wishMs = Number.POSITIVE_INFINITY;
  }

  /** A command leaves. @param linear m/s @param angular rad/s @param lateral m/s, to the left */
  add(nowMs: number, linear: number, angular: number, lateral = 0): void {
    this.expire(nowMs);
    this.#sentMs = nowMs;
    this.#wishMs = Number.POSITIVE_INFINITY;
    this.#push(nowMs, linear, angular, lateral);
  }

  /** What the hand wants now; the next command will carry it. */
  wish(nowMs: number, linear: number, angular: number, lateral = 0): void {
    if (this.#isLast(linear, angular, lateral)) {
      this.#wishMs = Number.POSITIVE_INFINITY;
      return;
    }
    if (this.#wishMs === Number.POSITIVE_INFINITY) this.#wishMs = nowMs;
    this.#wishLinear = linear;
    this.#wishAngular = angular;
    this.#wishLateral = lateral;
  }

  /** Nobody wants anything that was not sent. */
  noWish(): void {
    this.#wishMs = Number.POSITIVE_INFINITY;
  }

  /** Call it now and then: when no command has left for the watchdog's time, the robot stands. */
  expire(nowMs: number): void {
    const lapsesMs = this.#sentMs + this.#watchdogMs();
    if (nowMs >= lapsesMs) this.#push(lapsesMs, 0, 0, 0);
  }

  /** Changes that are kept, the wish not among them. */
  get length(): number {
    return this.#length;
  }

  /** What is not known any more is older than this; −Infinity if nothing was forgotten. */
  get knownSinceMs(): number {
    return this.#forgets ? this.timeMs(0) : Number.NEGATIVE_INFINITY;
  }

  /** @param index from the oldest, 0; −1 stands for all time before it */
  timeMs(index: number): number {
    return index < 0 ? Number.NEGATIVE_INFINITY : (this.#times[this.#at(index)] as number);
  }

  linear(index: number): number {
    return index < 0 ? 0 : (this.#linear[this.#at(index)] as number);
  }

  angular(index: number): number {
    return index < 0 ? 0 : (this.#angular[this.#at(index)] as number);
  }

  lateral(index: number): number {
    return index < 0 ? 0 : (this.#lateral[this.#at(index)] as number);
  }

  /** Index of what was valid at this time; −1 before the first. */
  indexAt(timeMs: number): number {
    let low = -1;
    let high = this.#length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.timeMs(middle) <= timeMs) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  /** When the wish began that is not sent yet; Infinity if there is none. */
  get wishMs(): number {
    return this.#wishMs;
  }

  get wishLinear(): number {
    return this.#wishLinear;
  }

  get wishAngular(): number {
    return this.#wishAngular;
  }

  get wishLateral(): number {
    return this.#wishLateral;
  }

  #isLast(linear: number, angular: number, lateral: number): boolean {
    const last = this.#length - 1;
    return linear === this.linear(last) && angular === this.angular(last) && lateral === this.lateral(last);
  }

  #push(timeMs: number, linear: number, angular: number, lateral: number): void {
    if (this.#isLast(linear, angular, lateral)) return;
    const last = this.#length - 1;
    // Clocks that step back would break the order.
    const ordered = Math.max(timeMs, this.timeMs(last));
    if (this.#length === CAPACITY) {
      this.#first = (this.#first + 1) % CAPACITY;
      this.#forgets = true;
    } else this.#length++;
    const at = this.#at(this.#length - 1);
    this.#times[at] = ordered;
    this.#linear[at] = linear;
    this.#angular[at] = angular;
    this.#lateral[at] = lateral;
  }

  #at(index: number): number {
    return (this.#first + index) % CAPACITY;
  }
}
