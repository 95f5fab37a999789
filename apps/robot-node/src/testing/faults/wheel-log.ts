import { Waiters } from '@farpoint/service/testing/waiters';
import { ReferenceControlReader } from '@farpoint/shared-memory';

const POLL_MS = 2;
const KEPT = 4000;

interface Sample {
  atMs: number;
  linear: number;
  counter: number;
}

/** What the wheels are told, over time: reads the command block as the program that moves them would. */
export class WheelLog {
  readonly #block: ReferenceControlReader;
  readonly #samples: Sample[] = [];
  readonly #timer: NodeJS.Timeout;
  readonly #waiters = new Waiters();
  /** The highest speed that was ever asked of the wheels. */
  fastest = 0;

  constructor(folder: string) {
    this.#block = new ReferenceControlReader(folder);
    this.#timer = setInterval(() => this.#poll(), POLL_MS);
  }

  get speed(): number {
    return this.#samples.at(-1)?.linear ?? 0;
  }

  /** Resolves as soon as `is` holds for the newest velocity. */
  until(is: (sample: Sample) => boolean): Promise<void> {
    return this.#waiters.until(() => {
      const newest = this.#samples.at(-1);
      return newest !== undefined && is(newest);
    });
  }

  /** Resolves after the robot has written so many velocities: 25 a second at least, while it runs. */
  async beats(count: number): Promise<void> {
    const from = this.#samples.at(-1)?.counter ?? 0;
    await this.until(({ counter }) => counter - from >= count);
  }

  /** Resolves when the robot has written nothing for this long, ms. */
  async silence(ms: number): Promise<void> {
    await this.until((newest) => {
      const since = this.#samples.findLast(({ counter }) => counter !== newest.counter)?.atMs ?? 0;
      return newest.atMs - since >= ms;
    });
  }

  /**
   * When the wheels were first told less than before, or were told nothing any more.
   *
   * @param fromMs the cause, `performance.now()`
   * @returns ms after the cause, and the longest time that this log did not look
   */
  brakingAfter(fromMs: number): { afterMs: number; blindMs: number } | null {
    const before = this.#samples.findLast(({ atMs }) => atMs <= fromMs);
    if (before === undefined) return null;
    let last = before;
    let blindMs = 0;
    for (const sample of this.#samples) {
      if (sample.atMs <= fromMs) continue;
      blindMs = Math.max(blindMs, sample.atMs - last.atMs);
      if (sample.linear < before.linear - 1e-9) return { afterMs: sample.atMs - fromMs, blindMs };
      last = sample;
    }
    return null;
  }

  /** When the last velocity was written, `performance.now()`. */
  get lastWrittenMs(): number {
    const newest = this.#samples.at(-1);
    return this.#samples.find(({ counter }) => counter === newest?.counter)?.atMs ?? 0;
  }

  close(): void {
    clearInterval(this.#timer);
    this.#block.close();
  }

  #poll(): void {
    const block = this.#block.read();
    if (block === null) return;
    const linear = block.twist.linear.x;
    this.fastest = Math.max(this.fastest, Math.abs(linear), Math.abs(block.twist.angular.z));
    this.#samples.push({ atMs: performance.now(), linear, counter: block.counter });
    if (this.#samples.length > KEPT) this.#samples.shift();
    this.#waiters.changed();
  }
}
