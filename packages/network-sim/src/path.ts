import type { EventQueue } from './event-queue.ts';
import type { LossModel, PacketLoss } from './loss.ts';
import type { Stalls } from './stalls.ts';
import type { PacketFate, VirtualLink } from './virtual-link.ts';

export interface PathOptions {
  /** Shared by all flows that pass it. */
  readonly link: VirtualLink;
  /** Propagation beyond the link's own, ms. */
  readonly moreDelayMs?: number;
  /**
   * Losses behind the link, as on a radio channel: unlike those of the link's profile, what is lost here has taken its share
   * of the capacity. The process may be shared by several paths.
   */
  readonly loss?: { readonly process: PacketLoss; readonly model: LossModel };
  /** The receiver stands still: it notes what comes meanwhile as come at the end. */
  readonly receiverStalls?: Stalls | null;
}

/** One direction between two ends: a link, and what lies beyond it for one flow. */
export class Path {
  readonly #events: EventQueue;
  readonly #options: PathOptions;

  constructor(events: EventQueue, options: PathOptions) {
    this.#events = events;
    this.#options = options;
  }

  /** A packet sets out now. */
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
