import type { EventQueue } from './event-queue.ts';
import { LinkModel } from './link-model.ts';
import type { DropReason } from './link-statistics.ts';
import type { LinkProfile } from './profile.ts';
import type { Stalls } from './stalls.ts';

/** What becomes of a packet; told in virtual time, from within the link, which must not be called back. */
export interface PacketFate {
  /**
   * @param atMs now, or later where the link stood still
   * @param queueMs from its arrival until its last bit had left the bottleneck, stalls included
   */
  delivered(atMs: number, queueMs: number): void;
  dropped(reason: DropReason): void;
}

export interface VirtualLinkOptions {
  readonly profile: LinkProfile;
  readonly seed: number;
  /** The link stands still: what comes, or is due to leave the bottleneck, does so after the stall. */
  readonly stalls?: Stalls | null;
}

interface Waiting {
  readonly fate: PacketFate;
  readonly sentMs: number;
  readonly enteredMs: number;
}

const ROUNDING_MS = 1e-6;

/** A {@link LinkModel} that runs by an {@link EventQueue}: for flows that share one link in virtual time. */
export class VirtualLink {
  readonly model: LinkModel;
  readonly #events: EventQueue;
  readonly #stalls: Stalls | null;
  /** Packets under way, by handle. */
  readonly #packets: (Waiting | null)[] = [];
  readonly #free: number[] = [];
  #wakeMs = Number.POSITIVE_INFINITY;
  /** When the latest packet came out. */
  #latestMs = Number.NEGATIVE_INFINITY;

  constructor(events: EventQueue, { profile, seed, stalls = null }: VirtualLinkOptions) {
    this.#events = events;
    this.#stalls = stalls;
    const delivered = (handle: number, atMs: number, queueMs: number) => this.#deliver(handle, atMs, queueMs);
    const sink = { delivered, duplicated: () => {} };
    this.model = new LinkModel({ profile, seed, startMs: events.nowMs, sink });
  }

  /** A packet arrives now. */
  send(bytes: number, fate: PacketFate): void {
    const { nowMs } = this.#events;
    const entersMs = this.#stalls?.after(nowMs) ?? nowMs;
    const packet = { fate, sentMs: nowMs, enteredMs: entersMs };
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
    const { fate, sentMs, enteredMs } = this.#packets[handle]!;
    this.#release(handle);
    const departedMs = enteredMs + queueMs;
    const leavesMs = this.#stalls?.after(departedMs) ?? departedMs;
    const comesMs = atMs + leavesMs - departedMs;
    // What a stall has held back comes out at one instant and in its order, which a rounding error must not turn round.
    if (Math.abs(comesMs - this.#latestMs) > ROUNDING_MS) this.#latestMs = comesMs;
    fate.delivered(this.#latestMs, leavesMs - sentMs);
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
