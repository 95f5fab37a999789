import type { Clock } from './clock.ts';
import type { Peer } from './peer.ts';

/** A list that changes. */
export interface ListingSource {
  /** Grows with every change. */
  readonly version: number;
  /** The list, as a message. */
  whole(): Uint8Array;
  /** What brings the list of an earlier version up to date, as a message. */
  since(version: number): Uint8Array;
}

export interface ListingFeedOptions {
  readonly clock: Clock;
  readonly listing: ListingSource;
  /** Least time between two rounds, ms. */
  readonly intervalMs: number;
  /** All lists together may take this much: each slice is followed by a pause that sees to it. */
  readonly bytesPerSecond: number;
  /** Bytes sent before other work gets its turn. */
  readonly sliceBytes?: number;
  /** A peer with more bytes waiting than this is passed over until it has caught up. */
  readonly maxBacklogBytes?: number;
}

/** What one message costs beside its bytes: a system call, about as long as copying this much. */
const MESSAGE_COST_BYTES = 4096;

/**
 * Keeps operators' lists of robots fresh: the whole list once, then what changes. A change goes out at once when all was
 * quiet; under many changes there is at most one round per interval, each operator gets all that it misses in one
 * message, and a big round goes out in slices with pauses between, so that neither relays nor the network wait behind it.
 */
export class ListingFeed {
  readonly #clock: Clock;
  readonly #listing: ListingSource;
  readonly #intervalMs: number;
  readonly #bytesPerMs: number;
  readonly #sliceBytes: number;
  readonly #maxBacklogBytes: number;
  /** Each subscriber with the version it has. */
  readonly #subscribers = new Map<Peer, number>();
  #queue: Peer[] = [];
  #earliest = Number.NEGATIVE_INFINITY;
  #changed = false;
  #cancel: (() => void) | null = null;

  constructor(options: ListingFeedOptions) {
    this.#clock = options.clock;
    this.#listing = options.listing;
    this.#intervalMs = options.intervalMs;
    this.#bytesPerMs = options.bytesPerSecond / 1000;
    this.#sliceBytes = options.sliceBytes ?? 262_144;
    this.#maxBacklogBytes = options.maxBacklogBytes ?? 65_536;
  }

  /** Sends the list now, and later what changes in it. */
  add(peer: Peer): void {
    this.#send(peer, this.#listing.whole());
  }

  remove(peer: Peer): void {
    this.#subscribers.delete(peer);
  }

  /** The list has changed. */
  changed(): void {
    this.#changed = true;
    // A round that is under way is followed by another.
    if (this.#cancel === null) this.#schedule();
  }

  stop(): void {
    this.#cancel?.();
    this.#cancel = null;
    this.#queue = [];
    this.#subscribers.clear();
  }

  #schedule(): void {
    const wait = Math.max(0, this.#earliest - this.#clock.now());
    this.#cancel = this.#clock.after(wait, () => {
      this.#changed = false;
      this.#queue = [...this.#subscribers.keys()];
      this.#slice();
    });
  }

  #slice(): void {
    let budget = this.#sliceBytes;
    let peer = this.#queue.pop();
    for (; peer !== undefined; peer = budget > 0 ? this.#queue.pop() : undefined) {
      const has = this.#subscribers.get(peer);
      if (has === undefined || has === this.#listing.version) continue;
      if (peer.backlog > this.#maxBacklogBytes) {
        this.#changed = true; // it is behind: once more in the next round
        continue;
      }
      const message = this.#listing.since(has);
      this.#send(peer, message);
      budget -= message.byteLength + MESSAGE_COST_BYTES;
    }
    const pause = (this.#sliceBytes - budget) / this.#bytesPerMs;
    if (this.#queue.length > 0) {
      this.#cancel = this.#clock.after(pause, () => this.#slice());
      return;
    }
    this.#cancel = null;
    this.#earliest = this.#clock.now() + Math.max(this.#intervalMs, pause);
    if (this.#changed) this.#schedule();
  }

  #send(peer: Peer, message: Uint8Array): void {
    this.#subscribers.set(peer, this.#listing.version);
    peer.send(message);
  }
}
