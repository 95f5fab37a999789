/** May another operator take the lease from the one who holds it? */
export type TakePolicy =
  | 'never'
  | 'idle' // where the holder has asked for no motion for a while
  | 'always';

export interface LeaseOptions {
  /** Cryptographically random bytes: a lease cannot be guessed. */
  randomBytes: (count: number) => Uint8Array;
  /** Default `idle`. */
  takePolicy?: TakePolicy;
  /** After how long without motion a holder counts as idle, ms. */
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

/** Who may drive: one operator at a time, under an opaque lease that every command must repeat. */
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

  /** The operator's lease, `null` for everyone but the holder. */
  leaseOf(operatorId: string): string | null {
    return this.#held?.operatorId === operatorId ? this.#held.lease : null;
  }

  /** True where this very operator holds this very lease. */
  holds(operatorId: string, lease: string): boolean {
    return this.#held?.operatorId === operatorId && this.#held.lease === lease;
  }

  /** Asking again changes nothing for the holder: same lease. */
  request(operatorId: string, take: boolean, nowMs: number): LeaseOutcome {
    const held = this.#held;
    if (held === null) return this.#grant(operatorId, null, nowMs);
    if (held.operatorId === operatorId) return { granted: true, lease: held.lease, takenFrom: null };
    if (!take) return { granted: false, reason: 'held', detail: 'another operator drives' };
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

  /** @returns false where the operator did not hold the lease */
  release(operatorId: string): boolean {
    if (this.#held?.operatorId !== operatorId) return false;
    this.#held = null;
    return true;
  }

  /** The holder asked for motion and got it: not idle. */
  noteMotion(nowMs: number): void {
    if (this.#held !== null) this.#held.lastMotionMs = nowMs;
  }

  #grant(operatorId: string, takenFrom: string | null, nowMs: number): LeaseOutcome {
    const lease = Array.from(this.#randomBytes(16), (b) => b.toString(16).padStart(2, '0')).join('');
    this.#held = { operatorId, lease, lastMotionMs: nowMs };
    return { granted: true, lease, takenFrom };
  }
}
