import { EventQueue } from '@farpoint/network-sim';

/**
 * The network's events on the timers of the rest: one clock for both. Packets arrive at whole milliseconds, as timers fire,
 * so that the order of a run depends on no fraction.
 */
export class TimedEvents extends EventQueue {
  #armedMs = Number.POSITIVE_INFINITY;

  override at(timeMs: number, action: () => void): void {
    this.#catchUp();
    super.at(timeMs, action);
    this.#arm();
  }

  /** Runs what is due by now. Call it before anything is sent. */
  advance(): void {
    this.runUntil(performance.now());
    this.#arm();
  }

  #catchUp(): void {
    if (this.nextMs > performance.now()) this.runUntil(performance.now());
  }

  #arm(): void {
    const dueMs = Math.ceil(this.nextMs);
    if (dueMs >= this.#armedMs || dueMs === Number.POSITIVE_INFINITY) return;
    this.#armedMs = dueMs;
    setTimeout(() => {
      if (this.#armedMs === dueMs) this.#armedMs = Number.POSITIVE_INFINITY;
      this.advance();
    }, dueMs - performance.now());
  }
}
