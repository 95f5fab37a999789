/** Which packets of a stream are missing, and when to request them again. Time is an argument. */
import { SequenceNumber, SequenceUnwrapper } from './sequence-number.ts';

export interface LossRequestOptions {
  /** A packet may be late by this much before it is requested, ms. */
  reorderMs: number;
  /** Interval between two requests for the same packet, ms. */
  againMs: number;
  /** Maximum number of requests for one packet. */
  most: number;
  /** After this long, the packet would be of no use, ms. */
  uselessMs: number;
}

interface Missing {
  sinceMs: number;
  asked: number;
  nextMs: number;
}

/** If more are missing, none is requested: the path is down, not lossy. */
const MAX_MISSING = 512;

export class LossRequests {
  /** Packets that never arrived, or arrived only after a request. */
  lost = 0;
  recovered = 0;
  readonly #options: LossRequestOptions;
  readonly #unwrapper = new SequenceUnwrapper();
  readonly #missing = new Map<number, Missing>();
  #newest: number | null = null;

  constructor(options: LossRequestOptions) {
    this.#options = options;
  }

  /** @param sequence RTP sequence number of a packet that arrived */
  onPacket(sequence: number, nowMs: number): void {
    const index = this.#unwrapper.unwrap(sequence);
    const newest = this.#newest;
    if (newest === null || index > newest) {
      this.#newest = index;
      if (newest === null) return;
      const from = Math.max(newest + 1, index - MAX_MISSING);
      this.lost += from - newest - 1;
      for (let i = from; i < index; i++) this.#add(i, nowMs);
      return;
    }
    const missing = this.#missing.get(index);
    if (missing === undefined) return;
    this.#missing.delete(index);
    if (missing.asked > 0) this.recovered++;
  }

  /** Sequence numbers to request now, in order. */
  due(nowMs: number): number[] {
    const { againMs, most, uselessMs } = this.#options;
    const asked: number[] = [];
    for (const [index, missing] of this.#missing) {
      const isUseless =
        nowMs - missing.sinceMs > uselessMs || (missing.asked >= most && nowMs >= missing.nextMs);
      if (isUseless) {
        this.#missing.delete(index);
        this.lost++;
      } else if (nowMs >= missing.nextMs) {
        missing.asked++;
        missing.nextMs = nowMs + againMs;
        asked.push(SequenceNumber.of(index));
      }
    }
    return asked;
  }

  /** Whether {@link due} may return something later. */
  get waiting(): boolean {
    return this.#missing.size > 0;
  }

  #add(index: number, nowMs: number): void {
    this.#missing.set(index, { sinceMs: nowMs, asked: 0, nextMs: nowMs + this.#options.reorderMs });
    if (this.#missing.size <= MAX_MISSING) return;
    this.#missing.delete(this.#missing.keys().next().value as number);
    this.lost++;
  }
}
