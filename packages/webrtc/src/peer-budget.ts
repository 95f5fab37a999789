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

/** The time of one peer. */
export class PeerBudget {
  readonly #watching = buckets(WATCHER_LIMITS);
  readonly #driving = buckets(DRIVER_LIMITS);
  readonly #drives: () => boolean;

  /** @param drives whether the peer drives now */
  constructor(drives: () => boolean = () => false) {
    this.#drives = drives;
  }

  /** @returns false if what costs so much must be dropped */
  take(intake: Intake, work: number, nowMs: number): boolean {
    return (this.#drives() ? this.#driving : this.#watching)[intake].take(nowMs, work);
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
