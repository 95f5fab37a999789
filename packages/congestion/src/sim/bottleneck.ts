import type { Random } from './random.ts';

/** Capacity from `fromMs` on, until the next step. */
export interface CapacityStep {
  fromMs: number;
  bitsPerSecond: number;
}

/** Two states, good and bad, each with its own loss (Gilbert and Elliott); changes happen per packet. */
export interface BurstLoss {
  enterBad: number;
  leaveBad: number;
  lossInBad: number;
}

export interface BottleneckOptions {
  /** In ascending order; the first at 0. The last one holds for ever. */
  capacity: readonly CapacityStep[];
  /** Drop-tail: what finds this many bytes waiting is dropped. */
  queueBytes: number;
  /** In place of that: so many ms of the capacity of the moment, and at least two packets. */
  queueMs?: number;
  /** Packets that are lost behind the queue whatever its length, 0–1. */
  loss?: number;
  burstLoss?: BurstLoss;
}

/** One first-in-first-out link. No events of its own: when a packet leaves is known as it enters. */
export class Bottleneck {
  readonly #steps: readonly CapacityStep[];
  readonly #queueBytes: number;
  readonly #queueMs: number | null;
  #limitBytes = 3000;
  readonly #loss: number;
  readonly #burst: BurstLoss | null;
  readonly #random: Random;
  #bad = false;
  #step = 0;
  #limitStep = 0;
  /** When what has entered will have left. */
  #busyUntilMs = 0;
  /** Waiting packets: when each leaves and its size, as rings. */
  readonly #departures: number[] = [];
  readonly #sizes: number[] = [];
  #head = 0;
  #waitingBytes = 0;
  /** Dropped because the queue was full. */
  overflows = 0;

  constructor(options: BottleneckOptions, random: Random) {
    this.#steps = options.capacity;
    this.#queueBytes = options.queueBytes;
    this.#queueMs = options.queueMs ?? null;
    this.#loss = options.loss ?? 0;
    this.#burst = options.burstLoss ?? null;
    this.#random = random;
  }

  /**
   * A packet comes to the queue; calls in ascending time.
   *
   * @returns when it has left the link, ms; −1: dropped by the full queue
   */
  enter(bytes: number, nowMs: number): number {
    while (this.#head < this.#departures.length && (this.#departures[this.#head] as number) <= nowMs) {
      this.#waitingBytes -= this.#sizes[this.#head] as number;
      this.#head++;
    }
    if (this.#head > 4096) {
      this.#departures.splice(0, this.#head);
      this.#sizes.splice(0, this.#head);
      this.#head = 0;
    }
    if (this.#waitingBytes + bytes > this.#limit(nowMs)) {
      this.overflows++;
      return -1;
    }
    const leaves = this.#serve(Math.max(nowMs, this.#busyUntilMs), bytes * 8);
    this.#busyUntilMs = leaves;
    this.#departures.push(leaves);
    this.#sizes.push(bytes);
    this.#waitingBytes += bytes;
    return leaves;
  }

  /** Whether a packet that has left is lost on its way all the same. */
  loses(): boolean {
    const burst = this.#burst;
    if (burst !== null) {
      this.#bad = this.#random() < (this.#bad ? 1 - burst.leaveBad : burst.enterBad);
      if (this.#bad && this.#random() < burst.lossInBad) return true;
    }
    return this.#loss > 0 && this.#random() < this.#loss;
  }

  #limit(nowMs: number): number {
    if (this.#queueMs === null) return this.#queueBytes;
    while (this.#limitStep + 1 < this.#steps.length && this.#stepAt(this.#limitStep + 1).fromMs <= nowMs)
      this.#limitStep++;
    const { bitsPerSecond } = this.#stepAt(this.#limitStep);
    // While the link stands still the queue keeps the size it had.
    if (bitsPerSecond > 0) this.#limitBytes = Math.max((bitsPerSecond * this.#queueMs) / 8000, 3000);
    return this.#limitBytes;
  }

  /** When `bits` that begin at `fromMs` are through. */
  #serve(fromMs: number, bits: number): number {
    let time = fromMs;
    let left = bits;
    for (;;) {
      while (this.#step + 1 < this.#steps.length && this.#stepAt(this.#step + 1).fromMs <= time) this.#step++;
      const perMs = this.#stepAt(this.#step).bitsPerSecond / 1000;
      const next =
        this.#step + 1 < this.#steps.length ? this.#stepAt(this.#step + 1).fromMs : Number.POSITIVE_INFINITY;
      if (perMs * (next - time) >= left && perMs > 0) return time + left / perMs;
      // A link that stands still for ever: nothing that enters comes out.
      if (next === Number.POSITIVE_INFINITY) return Number.POSITIVE_INFINITY;
      left -= perMs * (next - time);
      time = next;
    }
  }

  #stepAt(i: number): CapacityStep {
    return this.#steps[i] as CapacityStep;
  }
}

/** Bits that a link of this capacity could carry between two times. */
export function capacityBits(steps: readonly CapacityStep[], fromMs: number, toMs: number): number {
  let bits = 0;
  for (const [i, step] of steps.entries()) {
    const begin = Math.max(step.fromMs, fromMs);
    const end = Math.min(steps[i + 1]?.fromMs ?? Number.POSITIVE_INFINITY, toMs);
    if (end > begin) bits += ((end - begin) * step.bitsPerSecond) / 1000;
  }
  return bits;
}
