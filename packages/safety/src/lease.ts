/** Whether another operator may take the lease from its holder. */
export type TakePolicy =
  | 'never'
  | 'idle' // if the holder has requested no motion for a while
  | 'always';

export interface LeaseOptions {
  /** Cryptographically random bytes, so that nobody can guess a lease. */
  randomBytes: (count: number) => Uint8Array;
  /** Default `idle`. */
  takePolicy?: TakePolicy;
  /** A holder counts as idle after this long without motion, ms. */
  takeAfterIdleMs?: number;
}

export type LeaseRefusal =
  | 'held' // another operator drives, and the request did not ask to take over
  | 'take-refused'; // another operator drives and may not be interrupted now

export type LeaseOutcome =
  | { granted: true; lease: string; takenFrom: string | null }
  | { granted: false; reason: LeaseRefusal; detail: string };

interface Held {
  operatorId: string;
  lease: string;
  lastMotionMs: number;
}

/** Decides who may drive: one operator at a time, under an opaque lease that every command must repeat. */
export class LeaseTable {
  readonly #randomBytes: (count: number) => Uint8Array;
  readonly #takePolicy: TakePolicy;
  readonly #takeAfterIdleMs: number;
  #held: Held | null = null;

  constructor(options: LeaseOptions) {
    this.#randomBytes = options.randomBytes;
    this.#takePolicy = options.takePolicy ?? 'idle';
    this.#takeAfterIdleMs = options.takeAfterIdleMs ?? 5000;
  }

  get holder(): string | null {
    return this.#held?.operatorId ?? null;
  }

  /** The operator's lease; `null` for everyone but the holder. */
  leaseOf(operatorId: string): string | null {
    return this.#held?.operatorId === operatorId ? this.#held.lease : null;
  }

  /** Whether this operator holds this lease. */
  holds(operatorId: string, lease: string): boolean {
    return this.#held?.operatorId === operatorId && this.#held.lease === lease;
  }

  /**
   * For the holder, asking again changes nothing: it gets the same lease.
   *
   * @param supervises whether the policy on take-overs does not bind this operator
   */
  request(operatorId: string, take: boolean, nowMs: number, supervises = false): LeaseOutcome {
    const held = this.#held;
    if (held === null) return this.#grant(operatorId, null, nowMs);
    if (held.operatorId === operatorId) return { granted: true, lease: held.lease, takenFrom: null };
    if (!take) return { granted: false, reason: 'held', detail: 'another operator drives' };
    if (supervises) return this.#grant(operatorId, held.operatorId, nowMs);
    const idleMs = nowMs - held.lastMotionMs;
    if (this.#takePolicy === 'always' || (this.#takePolicy === 'idle' && idleMs >= this.#takeAfterIdleMs)) {
      return this.#grant(operatorId, held.operatorId, nowMs);
    }
    const detail =
      this.#takePolicy === 'never'
        ? 'another operator drives, and this robot lets nobody take over'
        : `another operator drives; ask again when nothing has moved for ${this.#takeAfterIdleMs / 1000} s`;
    return { granted: false, reason: 'take-refused', detail };
  }

  /** The holder gives it to another operator, under a new lease. @returns false if `from` did not hold it: nothing has changed */
  handOver(from: string, to: string, nowMs: number): boolean {
    if (this.#held?.operatorId !== from || from === to) return false;
    this.#grant(to, from, nowMs);
    return true;
  }

  /** @returns false if the operator did not hold the lease */
  release(operatorId: string): boolean {
    if (this.#held?.operatorId !== operatorId) return false;
    this.#held = null;
    return true;
  }

  /** Records that the holder requested motion and got it, so it is not idle. */
  noteMotion(nowMs: number): void {
    if (this.#held !== null) this.#held.lastMotionMs = nowMs;
  }

  #grant(operatorId: string, takenFrom: string | null, nowMs: number): LeaseOutcome {
    const lease = Array.from(this.#randomBytes(16), (b) => b.toString(16).padStart(2, '0')).join('');
    this.#held = { operatorId, lease, lastMotionMs: nowMs };
    return { granted: true, lease, takenFrom };
  }
}
