import { PacketRing, type QueuedPacket } from './packet-queue.ts';
import { JITTER_SLOT_MS, type LinkProfile } from './profile.ts';
import { hashUniform, Random } from './random.ts';
import { TimeHeap } from './time-heap.ts';

/** Packets in flight behind the bottleneck: delay, jitter, reordering. */
export class Propagation {
  readonly #seed: number;
  readonly #random: Random;
  readonly #tailRandom: Random;
  readonly #ordered = new PacketRing();
  /** Packets that overtake or are overtaken. */
  readonly #strays = new TimeHeap<QueuedPacket>();
  #latestDueMs = Number.NEGATIVE_INFINITY;

  constructor(seed: number) {
    this.#seed = seed;
    this.#random = new Random(seed, 3);
    this.#tailRandom = new Random(seed, 5);
  }

  /** When the next packet arrives; Infinity if none is in flight. */
  get headMs(): number {
    return Math.min(this.#ordered.headMs, this.#strays.headMs);
  }

  /** A packet has left the bottleneck. @param originMs when the jitter's slots began */
  enter(packet: Readonly<QueuedPacket>, atMs: number, profile: LinkProfile, originMs: number): void {
    const { bytes, owner, handle } = packet;
    const queueMs = atMs - packet.timeMs;
    const { delayMs, jitterMs, jitterReorders, tailMs, reorder } = profile;
    let dueMs = atMs + delayMs;
    if (jitterMs > 0) {
      const uniform = jitterReorders
        ? this.#random.next()
        : hashUniform(this.#seed, Math.floor((atMs - originMs) / JITTER_SLOT_MS));
      dueMs = Math.max(atMs, dueMs + (2 * uniform - 1) * jitterMs);
    }
    if (tailMs > 0) dueMs -= tailMs * Math.log(1 - this.#tailRandom.next());
    if (this.#random.chance(reorder.probability)) {
      const timeMs = dueMs + reorder.extraMs;
      this.#strays.push(timeMs, { timeMs, bytes, owner, handle, queueMs });
    } else if (jitterReorders) {
      this.#strays.push(dueMs, { timeMs: dueMs, bytes, owner, handle, queueMs });
    } else {
      this.#latestDueMs = Math.max(this.#latestDueMs, dueMs);
      this.#ordered.push(this.#latestDueMs, bytes, owner, handle, queueMs);
    }
  }

  /** Removes the packet that arrives at {@link headMs}; there must be one. */
  shift(out: QueuedPacket): void {
    if (this.#ordered.headMs <= this.#strays.headMs) this.#ordered.shift(out);
    else Object.assign(out, this.#strays.shift());
  }
}
