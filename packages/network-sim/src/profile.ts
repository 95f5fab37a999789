import { type CapacitySpec, constantCapacity } from './capacity.ts';
import type { LossModel } from './loss.ts';

/**
 * Maximum backlog of the drop-tail queue, including the packet being sent. Packets that would exceed it are dropped.
 */
export type QueueLimit =
  | { readonly bytes: number }
  /** At the current capacity, or during an outage at the one before it; never less than {@link LEAST_QUEUE_BYTES}. */
  | { readonly ms: number };

/** Two full packets: a queue that holds less than one would drop everything. */
export const LEAST_QUEUE_BYTES = 3000;

/**
 * One direction of a link. Probabilities are 0 to 1, per packet. Losses are decided before the queue, as in Linux
 * netem: a lost packet uses no capacity.
 */
export interface LinkProfile extends LossModel {
  readonly capacity: CapacitySpec;
  /** Propagation, one way. */
  readonly delayMs: number;
  /** The delay varies uniformly by ± this much, never below 0. */
  readonly jitterMs: number;
  /**
   * False: the order is kept, and the variation is drawn anew every {@link JITTER_SLOT_MS}, as a radio's scheduler
   * does. True: it is drawn for each packet, and packets may overtake each other.
   */
  readonly jitterReorders: boolean;
  /**
   * Mean of an additional delay, exponentially distributed and drawn for each packet; the order is kept unless
   * `jitterReorders`.
   */
  readonly tailMs: number;
  /** This fraction of packets is later by this much and may be overtaken. */
  readonly reorder: { readonly probability: number; readonly extraMs: number };
  /** Fraction of packets that the link delivers twice. */
  readonly duplicate: number;
  readonly queue: QueueLimit;
}

/** For how long the delay of a radio stays the same, ms. Chosen: as long as a radio frame of LTE and 5G NR (3GPP TS 36.211, 38.211). */
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

/** Thrown for an invalid profile. */
export class ProfileError extends Error {
  override readonly name = 'ProfileError';
}

/** @throws {ProfileError} for a number outside its range; the capacity is checked when it is placed on the clock */
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
