import { TokenBucket, type TokenBucketOptions } from '@farpoint/timing';

/**
 * What an operator may send only so often. `probe` is a part of `control`, `lease` and `point` of `session`; `latch` is STOP on
 * `session`, and `stop` is STOP on `control`.
 */
const ratedMessages = [
  'control',
  'session',
  'bandwidth',
  'probe',
  'lease',
  'latch',
  'stop',
  'point',
] as const;
export type RatedMessage = (typeof ratedMessages)[number];

/**
 * Several times what the page sends, which is at most 120 commands, 10 reports and 2 probes a second. The control
 * channel also carries as many commands as a robot can be configured to accept (1000 a second): the drive guard judges
 * those, so that it sees every release of the grip.
 */
const RATES: Record<RatedMessage, TokenBucketOptions> = {
  control: { perSecond: 1200, burst: 1200 },
  session: { perSecond: 50, burst: 200 },
  bandwidth: { perSecond: 50, burst: 100 },
  probe: { perSecond: 20, burst: 40 },
  lease: { perSecond: 5, burst: 10 },
  latch: { perSecond: 10, burst: 20 },
  // A page repeats it 20 times a second until it is acknowledged.
  stop: { perSecond: 50, burst: 50 },
  // A page points as often as the hand has moved, but not more often than this.
  point: { perSecond: 10, burst: 10 },
};
/** Messages that latch the emergency stop are no longer than this, bytes. */
const MAX_LATCH_BYTES = 80;

/**
 * Limits how often one operator's messages are looked at, by kind. What exceeds a limit is dropped: before it is decoded
 * where the channel alone decides, otherwise before it acts.
 */
export class MessageRates {
  readonly #buckets = Object.fromEntries(
    ratedMessages.map((kind) => [kind, new TokenBucket(RATES[kind])]),
  ) as Record<RatedMessage, TokenBucket>;
  readonly #told = new TokenBucket({ perSecond: 1, burst: 1 });
  readonly #onOver: (kind: RatedMessage, tell: boolean) => void;

  /** @param onOver is called for each dropped message; `tell` at most once a second: the operator should be told */
  constructor(onOver: (kind: RatedMessage, tell: boolean) => void) {
    this.#onOver = onOver;
  }

  /** Whether one more message of this kind must be dropped. */
  over(kind: RatedMessage, nowMs: number): boolean {
    if (this.#buckets[kind].take(nowMs)) return false;
    this.#onOver(kind, this.#told.take(nowMs));
    return true;
  }

  /**
   * The same for a message that is not decoded yet. A flood of other messages never keeps an emergency stop from being
   * latched: messages that may be one have limits of their own.
   */
  drops(channel: 'control' | 'session' | 'bandwidth', data: string | Uint8Array, nowMs: number): boolean {
    if (channel === 'session' && mayLatch(data, 'true')) return this.over('latch', nowMs);
    if (channel === 'control' && mayLatch(data, '"press"')) return this.over('stop', nowMs);
    return this.over(channel, nowMs);
  }
}

function mayLatch(data: string | Uint8Array, has: string): boolean {
  if (data.length > MAX_LATCH_BYTES) return false;
  const text = typeof data === 'string' ? data : String.fromCharCode(...data);
  return text.includes('"estop"') && text.includes(has);
}
