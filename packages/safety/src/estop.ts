/** Who latched the emergency stop. */
export type EstopSource = 'operator' | 'robot';

/** `let-go`: released, but the hand has not let go of the stick since. */
export type EstopAnswer = 'clear' | 'latched' | 'let-go';

const MOST_LATCHERS = 64;

/**
 * The emergency stop: anyone can latch it, and only a deliberate action releases it. After the release, motion stays
 * refused until the hand has let go of the stick once (a command for zero, or no request for motion for `letGoMs`),
 * because a reset must not by itself start the machine (ISO 13850, 4.1.4).
 */
export class EstopLatch {
  readonly #letGoMs: number;
  #by: EstopSource | null = null;
  #number = 0;
  #ofOperator = false;
  /** Operators who have latched it since it was last clear, and are still there. */
  readonly #latchers = new Set<string>();
  /** When motion was last requested since the release; `null` once the hand has let go. */
  #heldMs: number | null = null;

  constructor(letGoMs: number) {
    this.#letGoMs = letGoMs;
  }

  get latched(): boolean {
    return this.#by !== null;
  }

  /** Who latched it first. */
  get by(): EstopSource | null {
    return this.#by;
  }

  /** Number of the latest latch, 0 before the first; wraps at 2³². A latch while it is latched counts as well. */
  get number(): number {
    return this.#number;
  }

  /** Whether an operator is among those who latched it. */
  get ofOperator(): boolean {
    return this.#ofOperator;
  }

  /** The operators who latched it and have neither withdrawn that nor left. */
  get latchers(): ReadonlySet<string> {
    return this.#latchers;
  }

  /** @returns false if it was already latched: its number has changed nevertheless */
  latch(by: EstopSource, operatorId?: string): boolean {
    this.#number = (this.#number + 1) >>> 0;
    this.#ofOperator ||= by === 'operator';
    // The bound is never met: a robot takes fewer operators.
    if (operatorId !== undefined && this.#latchers.size < MOST_LATCHERS) this.#latchers.add(operatorId);
    if (this.#by !== null) return false;
    this.#by = by;
    this.#heldMs = null;
    return true;
  }

  /** The operator has left, or wants its own latch released. It stays latched. */
  withdraw(operatorId: string): void {
    this.#latchers.delete(operatorId);
  }

  /** The caller has checked who asks. @returns false if it was not latched */
  release(nowMs: number): boolean {
    if (this.#by === null) return false;
    this.#by = null;
    this.#ofOperator = false;
    this.#latchers.clear();
    this.#heldMs = nowMs;
    return true;
  }

  /** Records a request of the lease holder and returns the answer to it. */
  meet(motion: boolean, nowMs: number): EstopAnswer {
    if (this.#by !== null) return 'latched';
    if (this.#heldMs === null) return 'clear';
    if (!motion || nowMs - this.#heldMs >= this.#letGoMs) {
      this.#heldMs = null;
      return 'clear';
    }
    this.#heldMs = nowMs;
    return 'let-go';
  }
}
