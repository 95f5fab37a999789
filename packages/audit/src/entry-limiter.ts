import { TokenBucket } from '@farpoint/timing';
import type { AuditEvent } from './audit-event.ts';

/** Of one kind and reason: this many at once, and then on average one in this time, ms. */
const BURST = 50;
const INTERVAL_MS = 5000;
/** Reasons are typed, so there are few. More than these share one allowance. */
const MOST_KEYS = 256;

/**
 * Bounds how much a peer can make a program write. It counts what was left out, by kind, or for refusals by kind and
 * reason.
 */
export class EntryLimiter {
  readonly #buckets = new Map<string, TokenBucket>();
  #omitted = new Map<string, number>();

  /** @returns whether the event may be written; if not, it is counted */
  admits(event: AuditEvent, nowMs: number): boolean {
    const reason = event.kind === 'refused' ? event.details?.reason : undefined;
    const named = typeof reason === 'string' ? `${event.kind}:${reason}` : event.kind;
    const key = this.#buckets.has(named) || this.#buckets.size < MOST_KEYS ? named : event.kind;
    let bucket = this.#buckets.get(key);
    if (bucket === undefined) {
      bucket = new TokenBucket({ perSecond: 1000 / INTERVAL_MS, burst: BURST });
      this.#buckets.set(key, bucket);
    }
    if (bucket.take(nowMs)) return true;
    this.#omitted.set(key, (this.#omitted.get(key) ?? 0) + 1);
    return false;
  }

  /** What was left out since the last call; null if nothing. */
  takeOmitted(): Readonly<Record<string, number>> | null {
    if (this.#omitted.size === 0) return null;
    const omitted = Object.fromEntries(this.#omitted);
    this.#omitted = new Map();
    return omitted;
  }
}
