import { type CapacitySpec, constantCapacity } from './capacity.ts';
import type { LossModel } from './loss.ts';

/** Longest backlog of the drop-tail queue; a packet that would exceed it is dropped. The packet being sent counts. */
export type QueueLimit =
  | { readonly bytes: number }
  /** At the capacity of the moment; during an outage at the one before it; never less than {@link LEAST_QUEUE_BYTES}. */
  | { readonly ms: number };

/** Two full packets: a queue that holds less than one would drop everything. */
export const LEAST_QUEUE_BYTES = 3000;

/**
 * One direction of a link. Probabilities are 0 to 1, per packet. Losses are decided before the queue, as Linux netem does
 * it: a lost packet takes no capacity.
 */
export interface LinkProfile extends LossModel {
  readonly capacity: CapacitySpec;
  /** Propagation, one way. */
  readonly delayMs: number;
  /** The delay varies evenly by ± this much, never below 0. */
  readonly jitterMs: number;
  /**
   * False: order is kept, and the variation is drawn anew every {@link JITTER_SLOT_MS}, as a radio's scheduler does it.
   * True: it is drawn for each packet, and packets overtake each other.
   */
  readonly jitterReorders: boolean;
  /** Mean of an extra delay, exponentially distributed and drawn for each packet; order is kept unless `jitterReorders`. */
  readonly tailMs: number;
  /** So many packets come this much later, and others overtake them. */
  readonly reorder: { readonly probability: number; readonly extraMs: number };
  /** Packets that the link carries twice. */
  readonly duplicate: number;
  readonly queue: QueueLimit;
}

export const JITTER_SLOT_MS = 10;

/** No limits but a queue of 1 MiB. */
export const idealProfile: LinkProfile = {
  capacity: constantCapacity(Number.POSITIVE_INFINITY),
  delayMs: 0,
  jitterMs: 0,
  jitterReorders: false,
  tailMs: 0,
  loss: 0,
  burstLoss: null,
  reorder: { probability: 0, extraMs: 0 },
  duplicate: 0,
  queue: { bytes: 1_048_576 },
};

/** A profile that cannot be. */
export class ProfileError extends Error {
  override readonly name = 'ProfileError';
}

/** @throws {ProfileError} for a number outside its range; the capacity is checked where it is laid on the clock */
export function checkProfile(profile: LinkProfile): void {
  const { delayMs, jitterMs, tailMs, loss, burstLoss, reorder, duplicate, queue } = profile;
  time('delay', delayMs);
  time('jitter', jitterMs);
  time('tail', tailMs);
  time('reorder delay', reorder.extraMs);
  probability('loss', loss);
  probability('reorder', reorder.probability);
  probability('duplicate', duplicate);
  if (burstLoss !== null) {
    for (const [name, value] of Object.entries(burstLoss))
      probability(`burst loss: ${name}`, value as number);
  }
  const limit = 'bytes' in queue ? queue.bytes : queue.ms;
  if (!(limit > 0)) throw new ProfileError(`queue: ${limit} is not more than 0`);
}

function time(what: string, ms: number): void {
  if (!(ms >= 0 && ms <= 600_000)) throw new ProfileError(`${what}: ${ms} is not 0 to 600,000 ms`);
}

function probability(what: string, value: number): void {
  if (!(value >= 0 && value <= 1)) throw new ProfileError(`${what}: ${value} is not a probability`);
}
