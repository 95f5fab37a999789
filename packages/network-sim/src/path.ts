import type { EventQueue } from './event-queue.ts';
import type { LossModel, PacketLoss } from './loss.ts';
import type { Stalls } from './stalls.ts';
import type { PacketFate, VirtualLink } from './virtual-link.ts';

export interface PathOptions {
  /** Shared by all flows that use it. */
  readonly link: VirtualLink;
  /** Propagation in addition to the link's own, ms. */
  readonly moreDelayMs?: number;
  /**
   * Losses behind the link, as on a radio channel. Unlike losses of the link's profile, packets lost here have used
   * their share of the capacity. Several paths may share the process.
   */
  readonly loss?: { readonly process: PacketLoss; readonly model: LossModel };
  /** The receiver stalls: packets that arrive meanwhile are recorded as arriving at the end of the stall. */
  readonly receiverStalls?: Stalls | null;
}

/** One direction between two ends: a link, and what lies behind it for one flow. */
export class Path {
  readonly #events: EventQueue;
  readonly #options: PathOptions;

  constructor(events: EventQueue, options: PathOptions) {
    this.#events = events;
    this.#options = options;
  }

  /** Sends a packet now. */
  send(bytes: number, fate: PacketFate): void {
    const { link, moreDelayMs = 0, loss, receiverStalls = null } = this.#options;
    link.send(bytes, {
      dropped: (reason) => fate.dropped(reason),
      delivered: (atMs, queueMs) => {
        const reason = loss?.process.next(loss.model) ?? null;
        if (reason !== null) return fate.dropped(reason);
        const arrivalMs = receiverStalls?.after(atMs + moreDelayMs) ?? atMs + moreDelayMs;
        if (arrivalMs <= this.#events.nowMs) fate.delivered(arrivalMs, queueMs);
        else this.#events.at(arrivalMs, () => fate.delivered(arrivalMs, queueMs));
      },
    });
  }
}
