/**
 * The common trigger of simulated cameras: each captures at the multiples of its interval, counted from the clock's
 * zero, so that cameras of equal rates capture at the same instants, and a slower one at some of a faster one's.
 */

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

export interface TriggeredCamera {
  readonly intervalNs: bigint;
  capture(atNs: bigint): void;
}

export class SimTrigger {
  /** Before a round of captures: all of them are to see the same world. */
  onRound: (() => void) | null = null;
  readonly #nowNs: () => bigint;
  readonly #times = new DueTimes<TriggeredCamera>();
  #timer: NodeJS.Timeout | null = null;

  constructor(nowNs: () => bigint) {
    this.#nowNs = nowNs;
  }

  /** @returns ends it */
  add(camera: TriggeredCamera): () => void {
    this.#times.add(camera, camera.intervalNs, this.#nowNs());
    this.#wait();
    return () => {
      this.#times.delete(camera);
      this.#wait();
    };
  }

  #wait(): void {
    if (this.#timer !== null) clearTimeout(this.#timer);
    this.#timer = null;
    const next = this.#times.next;
    if (next === null) return;
    const waitMs = Math.max(0, Math.ceil(Number(next - this.#nowNs()) / 1e6));
    this.#timer = setTimeout(() => this.#fire(), waitMs);
  }

  #fire(): void {
    const due = this.#times.take(this.#nowNs());
    if (due.length > 0) this.onRound?.();
    for (const { item, atNs } of due) item.capture(atNs);
    this.#wait();
  }
}
