import { TokenBucket } from '@farpoint/timing';
import type { AuditEvent } from './audit-event.ts';

/** Of one kind and reason by one subject: this many at once, and then on average one in this time, ms. */
const ONE = { burst: 50, perSecond: 0.2 };
/** The same by all together of whom no grant says who they are: they can be as many as they like. */
const UNPROVEN = { burst: 250, perSecond: 1 };
/** Beyond it, the allowance that was used longest ago is forgotten. */
const MOST_KEYS = 4096;
/** What was left out is counted for so many by name; more are counted by kind alone. */
const MOST_NAMED = 64;

/**
 * Bounds how much a peer can make a program write, without hiding what another does: each subject has an allowance of its
 * own, for each kind, and for refusals for each reason. It counts what was left out.
 */
export class EntryLimiter {
  /** The latest used last. */
  readonly #buckets = new Map<string, TokenBucket>();
  #omitted = new Map<string, number>();

  /** @returns whether the event may be written; if not, it is counted */
  admits(event: AuditEvent, nowMs: number): boolean {
    const reason = event.kind === 'refused' ? event.details?.reason : undefined;
    const kind = typeof reason === 'string' ? `${event.kind}:${reason}` : event.kind;
    const { who, proven } = whoIs(event);
    const own = this.#bucket(`${kind} ${who}`, ONE).take(nowMs);
    // Only what passes takes from what all have together: nobody can use that up alone.
    if (own && (proven || this.#bucket(kind, UNPROVEN).take(nowMs))) return true;
    const named = who === '' ? kind : `${kind} by ${who}`;
    const key = this.#omitted.has(named) || this.#omitted.size < MOST_NAMED ? named : kind;
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

  #bucket(key: string, rate: typeof ONE): TokenBucket {
    const bucket = this.#buckets.get(key) ?? new TokenBucket(rate);
    this.#buckets.delete(key);
    this.#buckets.set(key, bucket);
    const [oldest] = this.#buckets.keys();
    if (this.#buckets.size > MOST_KEYS && oldest !== undefined) this.#buckets.delete(oldest);
    return bucket;
  }
}

/** By the grant; or else by what cannot be chosen at will. What the program does itself counts as proven. */
function whoIs({ subject, session, details }: AuditEvent): { who: string; proven: boolean } {
  if (subject?.proven === true && subject.id !== undefined) return { who: subject.id, proven: true };
  const who = session ?? (typeof details?.address === 'string' ? details.address : undefined);
  if (who !== undefined) return { who, proven: false };
  return { who: '', proven: subject === undefined };
}
