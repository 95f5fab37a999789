import type { Random } from './random.ts';

/** How a process is kept from running by others on a busy machine. */
export interface StallOptions {
  /** How many begin in a second, on average; the times are independent. */
  perSecond: number;
  /** Bounds of their length, ms; evenly distributed. */
  lengthMs: readonly [number, number];
}

/** Sender, link emulator and browser on two processors that are busy drawing: about what was measured there. */
export const BUSY_COMPUTER = {
  sender: { perSecond: 4, lengthMs: [3, 25] },
  link: { perSecond: 2, lengthMs: [3, 20] },
  receiver: { perSecond: 4, lengthMs: [2, 15] },
} as const satisfies Record<string, StallOptions>;

/** Times at which a process stands still; whatever is due then happens at the end, all at once. Drawn as they are asked for. */
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

  /** @returns when what is due at `atMs` happens: then, or at the end of the stall it falls into; never turns an order round */
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
