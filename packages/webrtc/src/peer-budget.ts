/**
 * What a peer may make this process do, by what it costs. Only what is authentic is counted: a stranger who forges the
 * peer's address uses up nothing of it.
 */
import { TokenBucket, type TokenBucketOptions } from '@farpoint/timing';

/**
 * `sctp`: chunks; `rtcp`: packets in compounds, and what they list; `stun`: connectivity checks; `stun-again`: repetitions
 * of them, which somebody else may have seen and sent.
 */
export type Intake = 'sctp' | 'rtcp' | 'stun' | 'stun-again';

type Limits = Readonly<Record<Intake, TokenBucketOptions>>;

/** Someone who watches acknowledges what it gets, a few hundred packets a second at most, and says little itself. */
export const WATCHER_LIMITS: Limits = {
  sctp: { perSecond: 1000, burst: 2000 },
  rtcp: { perSecond: 500, burst: 1000 },
  stun: { perSecond: 50, burst: 200 },
  'stun-again': { perSecond: 50, burst: 200 },
};
/** Someone who drives sends commands as well: more than the robot takes of them. */
export const DRIVER_LIMITS: Limits = {
  sctp: { perSecond: 3000, burst: 6000 },
  rtcp: { perSecond: 1000, burst: 2000 },
  stun: { perSecond: 50, burst: 200 },
  'stun-again': { perSecond: 50, burst: 200 },
};

/** All who watch together, however many they are: about a third of a processor. */
export const SHARED_LIMITS: Limits = {
  sctp: { perSecond: 6000, burst: 12_000 },
  rtcp: { perSecond: 4000, burst: 8000 },
  stun: { perSecond: 400, burst: 3200 },
  'stun-again': { perSecond: 400, burst: 1600 },
};

/** What all peers that do not drive have in common. */
export class SharedBudget {
  readonly #buckets = buckets(SHARED_LIMITS);

  take(intake: Intake, work: number, nowMs: number): boolean {
    return this.#buckets[intake].take(nowMs, work);
  }
}

/** What one peer may use up. */
export class PeerBudget {
  readonly #watching = buckets(WATCHER_LIMITS);
  readonly #driving = buckets(DRIVER_LIMITS);
  readonly #drives: () => boolean;
  readonly #shared: SharedBudget;

  /** @param drives whether the peer drives now: then it takes nothing from what is shared, and needs nothing of it */
  constructor(drives: () => boolean = () => false, shared = new SharedBudget()) {
    this.#drives = drives;
    this.#shared = shared;
  }

  /** @returns false if what costs so much must be dropped */
  take(intake: Intake, work: number, nowMs: number): boolean {
    if (this.#drives()) return this.#driving[intake].take(nowMs, work);
    return this.#watching[intake].take(nowMs, work) && this.#shared.take(intake, work, nowMs);
  }
}

function buckets(limits: Limits): Record<Intake, TokenBucket> {
  return {
    sctp: new TokenBucket(limits.sctp),
    rtcp: new TokenBucket(limits.rtcp),
    stun: new TokenBucket(limits.stun),
    'stun-again': new TokenBucket(limits['stun-again']),
  };
}
