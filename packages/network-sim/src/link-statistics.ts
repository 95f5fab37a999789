import { BitRate } from '@farpoint/timing';

/** Why a packet does not leave the link. */
export const dropReasons = ['loss', 'burst-loss', 'queue-full', 'blackhole'] as const;
export type DropReason = (typeof dropReasons)[number];

/** Width of a bin of the statistics, ms. Chosen: queues that matter to a driver last longer. */
export const BIN_MS = 100;

/** What happened in one direction during {@link BIN_MS}. Bytes are bytes on the wire. */
export interface LinkBin {
  /** When the bin begins, on the clock that the model is given. */
  readonly timeMs: number;
  /** Mean over the bin; `null` if there is no bottleneck. */
  readonly capacityMbps: number | null;
  /** What the peers sent, including dropped packets. */
  readonly offeredBytes: number;
  /** What left the bottleneck, except for the competing flow. */
  readonly deliveredBytes: number;
  /** What left it for the competing flow. */
  readonly crossBytes: number;
  readonly offeredPackets: number;
  readonly deliveredPackets: number;
  /** From a packet's arrival until its last bit is sent: mean over the packets that left; 0 if none did. */
  readonly queueMsMean: number;
  /** The same, as a maximum; while nothing leaves, the age of the oldest packet at the bin's end. */
  readonly queueMsMax: number;
  /** Waiting at the bin's end, including the competing flow's packets. */
  readonly backlogBytes: number;
  /** Packets of the peers. */
  readonly drops: Readonly<Record<DropReason, number>>;
  /** Packets of the competing flow, for any reason. */
  readonly crossDrops: number;
}

/** The sums of one bin at a time. */
export class LinkStatistics {
  offeredBytes = 0;
  deliveredBytes = 0;
  crossBytes = 0;
  offeredPackets = 0;
  deliveredPackets = 0;
  crossDrops = 0;
  #queueMsSum = 0;
  #queueMsMax = 0;
  #drops = noDrops();

  departed(bytes: number, queueMs: number): void {
    this.deliveredBytes += bytes;
    this.deliveredPackets++;
    this.#queueMsSum += queueMs;
    if (queueMs > this.#queueMsMax) this.#queueMsMax = queueMs;
  }

  dropped(reason: DropReason): void {
    this.#drops[reason]++;
  }

  /** Returns the bin that ends here and resets the sums. */
  close(timeMs: number, capacityBits: number, backlogBytes: number, oldestMs: number): LinkBin {
    const packets = this.deliveredPackets;
    const bin: LinkBin = {
      timeMs,
      capacityMbps: Number.isFinite(capacityBits)
        ? BitRate.toMbps(BitRate.ofBits(capacityBits, BIN_MS))
        : null,
      offeredBytes: this.offeredBytes,
      deliveredBytes: this.deliveredBytes,
      crossBytes: this.crossBytes,
      offeredPackets: this.offeredPackets,
      deliveredPackets: packets,
      queueMsMean: packets === 0 ? 0 : this.#queueMsSum / packets,
      queueMsMax: Math.max(this.#queueMsMax, oldestMs),
      backlogBytes,
      drops: this.#drops,
      crossDrops: this.crossDrops,
    };
    this.offeredBytes = this.deliveredBytes = this.crossBytes = 0;
    this.offeredPackets = this.deliveredPackets = this.crossDrops = 0;
    this.#queueMsSum = this.#queueMsMax = 0;
    this.#drops = noDrops();
    return bin;
  }
}

function noDrops(): Record<DropReason, number> {
  return { loss: 0, 'burst-loss': 0, 'queue-full': 0, blackhole: 0 };
}
