import { TimeHeap } from './time-heap.ts';

/** Virtual time: actions run in order of their times, or in order of scheduling if the times are equal. */
export class EventQueue {
  nowMs = 0;
  readonly #actions = new TimeHeap<() => void>();

  /** When the next action is due; Infinity if there is none. */
  get nextMs(): number {
    return this.#actions.headMs;
  }

  /** A past time means now; Infinity means never. */
  at(timeMs: number, action: () => void): void {
    if (timeMs !== Number.POSITIVE_INFINITY) this.#actions.push(Math.max(timeMs, this.nowMs), action);
  }

  /** Runs everything up to and including this time. */
  runUntil(timeMs: number): void {
    while (this.#actions.headMs <= timeMs) {
      this.nowMs = this.#actions.headMs;
      this.#actions.shift()();
    }
    this.nowMs = timeMs;
  }
}
