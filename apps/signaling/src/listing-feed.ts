import type { Clock } from './clock.ts';
import type { Peer } from './peer.ts';

/** A list that changes. */
export interface ListingSource {
  /** Grows with every change. */
  readonly version: number;
  /** The whole list as a message. */
  whole(): Uint8Array;
  /** The changes since an earlier version, as a message. */
  since(version: number): Uint8Array;
}

export interface ListingFeedOptions {
  readonly clock: Clock;
  readonly listing: ListingSource;
  /** Minimum time between two rounds, ms. */
  readonly intervalMs: number;
  /** Byte rate limit for all lists together. A pause after each slice enforces it. */
  readonly bytesPerSecond: number;
  /** Bytes to send before other work gets its turn. */
  readonly sliceBytes?: number;
  /** A peer with a backlog above this is skipped until it has caught up. */
  readonly maxBacklogBytes?: number;
}

/** Older than any list: whoever has it gets the whole one. */
const BEFORE_ALL = -1;
/** Cost of a message in addition to its bytes: a system call takes about as long as copying this much. */
const MESSAGE_COST_BYTES = 4096;

/**
 * Keeps operators' lists of robots up to date: first the whole list, then its changes. After a quiet period, a change
 * is sent immediately. When there are many changes, there is at most one round per interval, and each operator gets
 * everything that it lacks in one message. A big round is sent in slices with pauses in between, so that it delays
 * neither relaying nor the network.
 */
export class ListingFeed {
  readonly #clock: Clock;
  readonly #listing: ListingSource;
  readonly #intervalMs: number;
  readonly #bytesPerMs: number;
  readonly #sliceBytes: number;
  readonly #maxBacklogBytes: number;
  /** Each subscriber with the version that it has. */
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

  /** Sends the list now, and its changes later. */
  add(peer: Peer): void {
    this.#send(peer, this.#listing.whole());
  }

  /** Sends the list in the next round, and its changes later: however often it is asked for, it is sent once a round. */
  addLater(peer: Peer): void {
    if (this.#subscribers.has(peer)) return;
    this.#subscribers.set(peer, BEFORE_ALL);
    this.changed();
  }

  remove(peer: Peer): void {
    this.#subscribers.delete(peer);
  }

  /** Call this when the list has changed. */
  changed(): void {
    this.#changed = true;
    // A round in progress is followed by another one.
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
        this.#changed = true; // it is behind: try again in the next round
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
