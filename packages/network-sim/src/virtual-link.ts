import type { EventQueue } from './event-queue.ts';
import { LinkModel } from './link-model.ts';
import type { DropReason } from './link-statistics.ts';
import type { LinkProfile } from './profile.ts';
import type { Stalls } from './stalls.ts';

/** What happens to a packet, reported in virtual time from within the link, which must not be called back. */
export interface PacketFate {
  /**
   * Called twice for a packet that the link has duplicated.
   *
   * @param atMs now, or later if the link stalled
   * @param queueMs from its arrival until its last bit had left the bottleneck, including stalls
   */
  delivered(atMs: number, queueMs: number): void;
  dropped(reason: DropReason): void;
}

export interface VirtualLinkOptions {
  readonly profile: LinkProfile;
  readonly seed: number;
  /** The link stalls: packets that arrive, or are due to leave the bottleneck, do so after the stall. */
  readonly stalls?: Stalls | null;
}

interface Waiting {
  readonly fate: PacketFate;
  readonly sentMs: number;
  readonly enteredMs: number;
  /** How often it is still to be delivered. */
  copies: number;
}

/** Two times nearer than this are the same. Chosen: above what sums of milliseconds lose in a double, below any link's packet. */
const ROUNDING_MS = 1e-6;

/** A {@link LinkModel} driven by an {@link EventQueue}: for flows that share one link in virtual time. */
export class VirtualLink {
  readonly model: LinkModel;
  readonly #events: EventQueue;
  readonly #stalls: Stalls | null;
  /** Packets in flight, by handle. */
  readonly #packets: (Waiting | null)[] = [];
  readonly #free: number[] = [];
  #wakeMs = Number.POSITIVE_INFINITY;
  /** When the latest packet arrived. */
  #latestMs = Number.NEGATIVE_INFINITY;

  constructor(events: EventQueue, { profile, seed, stalls = null }: VirtualLinkOptions) {
    this.#events = events;
    this.#stalls = stalls;
    const delivered = (handle: number, atMs: number, queueMs: number) => this.#deliver(handle, atMs, queueMs);
    const sink = { delivered, duplicated: (handle: number) => this.#duplicate(handle) };
    this.model = new LinkModel({ profile, seed, startMs: events.nowMs, sink });
  }

  /** A packet enters the link now. */
  send(bytes: number, fate: PacketFate): void {
    const { nowMs } = this.#events;
    const entersMs = this.#stalls?.after(nowMs) ?? nowMs;
    const packet = { fate, sentMs: nowMs, enteredMs: entersMs, copies: 1 };
    if (entersMs === nowMs) this.#offer(bytes, packet);
    else this.#events.at(entersMs, () => this.#offer(bytes, packet));
  }

  #offer(bytes: number, packet: Waiting): void {
    const handle = this.#free.pop() ?? this.#packets.push(null) - 1;
    this.#packets[handle] = packet;
    const reason = this.model.offer(bytes, packet.enteredMs, handle);
    if (reason !== null) {
      this.#release(handle);
      packet.fate.dropped(reason);
    }
    this.#arm();
  }

  #deliver(handle: number, atMs: number, queueMs: number): void {
    const packet = this.#packets[handle]!;
    const { fate, sentMs, enteredMs } = packet;
    packet.copies--;
    if (packet.copies === 0) this.#release(handle);
    const departedMs = enteredMs + queueMs;
    const leavesMs = this.#stalls?.after(departedMs) ?? departedMs;
    const comesMs = atMs + leavesMs - departedMs;
    // Packets held back by a stall arrive at one instant and in order; a rounding error must not reverse them.
    if (Math.abs(comesMs - this.#latestMs) > ROUNDING_MS) this.#latestMs = comesMs;
    fate.delivered(this.#latestMs, leavesMs - sentMs);
  }

  #duplicate(handle: number): void {
    this.#packets[handle]!.copies++;
  }

  #release(handle: number): void {
    this.#packets[handle] = null;
    this.#free.push(handle);
  }

  #arm(): void {
    const { wakeMs } = this.model;
    if (wakeMs >= this.#wakeMs) return;
    this.#wakeMs = wakeMs;
    this.#events.at(wakeMs, () => {
      if (this.#wakeMs === wakeMs) this.#wakeMs = Number.POSITIVE_INFINITY;
      this.model.advance(this.#events.nowMs);
      this.#arm();
    });
  }
}
