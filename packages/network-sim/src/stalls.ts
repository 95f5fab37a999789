import type { Random } from './random.ts';

/** How other processes on a busy machine keep a process from running. */
export interface StallOptions {
  /** Mean number of stalls that begin per second; their times are independent. */
  perSecond: number;
  /** Minimum and maximum length, ms; uniformly distributed. */
  lengthMs: readonly [number, number];
}

/** Sender, link emulator and browser on two processors that are busy drawing: approximately as measured there. */
export const BUSY_COMPUTER = {
  sender: { perSecond: 4, lengthMs: [3, 25] },
  link: { perSecond: 2, lengthMs: [3, 20] },
  receiver: { perSecond: 4, lengthMs: [2, 15] },
} as const satisfies Record<string, StallOptions>;

/** Times at which a process stalls; whatever is due during a stall happens at its end, all at once. Drawn on demand. */
export class Stalls {
  readonly #options: StallOptions;
  readonly #random: Random;
  readonly #begins: number[] = [];
  readonly #ends: number[] = [];
  #drawnUntilMs = 0;

  constructor(options: StallOptions, random: Random) {
    this.#options = options;
    this.#random = random;
  }

  /**
   * @returns when something due at `atMs` happens: then, or at the end of the stall it falls into; preserves the order
   */
  after(atMs: number): number {
    if (atMs === Number.POSITIVE_INFINITY) return atMs;
    while (this.#drawnUntilMs <= atMs) this.#draw();
    let low = 0;
    let high = this.#begins.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if ((this.#begins[middle] as number) <= atMs) low = middle + 1;
      else high = middle;
    }
    return Math.max(atMs, this.#ends[low - 1] ?? atMs);
  }

  #draw(): void {
    const { perSecond, lengthMs } = this.#options;
    const begin = this.#drawnUntilMs - (1000 / perSecond) * Math.log(1 - this.#random.next());
    const end = begin + lengthMs[0] + (lengthMs[1] - lengthMs[0]) * this.#random.next();
    this.#begins.push(begin);
    this.#ends.push(end);
    this.#drawnUntilMs = end;
  }
}
