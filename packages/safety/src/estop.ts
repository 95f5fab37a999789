/** Who latched the emergency stop. */
export type EstopSource = 'operator' | 'robot';

/** `let-go`: released, but the hand has not let go of the stick since. */
export type EstopAnswer = 'clear' | 'latched' | 'let-go';

/**
 * The emergency stop: anyone can latch it, and only a deliberate action releases it. After the release, motion stays
 * refused until the hand has let go of the stick once (a command for zero, or no request for motion for `letGoMs`),
 * because a reset must not by itself start the machine (ISO 13850, 4.1.4).
 */
export class EstopLatch {
  readonly #letGoMs: number;
  #by: EstopSource | null = null;
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

  /** @returns false if it was already latched */
  latch(by: EstopSource): boolean {
    if (this.#by !== null) return false;
    this.#by = by;
    this.#heldMs = null;
    return true;
  }

  /** The caller has checked who asks. @returns false if it was not latched */
  release(nowMs: number): boolean {
    if (this.#by === null) return false;
    this.#by = null;
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
