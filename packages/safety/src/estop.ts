import type { EstopState } from '@farpoint/protocol';
import type { RobotStop } from './robot-stop.ts';

/** Who latched the emergency stop. */
export type EstopSource = 'operator' | 'robot';

/** `let-go`: released, but the hand has not let go of the stick since. */
export type EstopAnswer = 'clear' | 'latched' | 'let-go';

const MOST_LATCHERS = 64;

/**
 * The emergency stop: anyone can latch it, and only a deliberate action releases it. After the release, motion stays
 * refused until the hand has let go of the stick once (a command for zero, or no request for motion for `letGoMs`),
 * because a reset must not by itself start the machine (ISO 13850, 4.1.4). Of a hand that asked for motion shortly before the
 * release or since, only a longer silence (`heldGapMs`) counts: it may have held on through a hitch.
 *
 * A stop at the robot itself, such as a button on it, *holds* it: while anything holds it, nothing else releases it.
 */
export class EstopLatch {
  readonly #letGoMs: number;
  #by: EstopSource | null = null;
  #number = 0;
  #ofOperator = false;
  #isAsked = false;
  /** The stops at the robot that hold it. */
  readonly #holders = new Set<RobotStop>();
  /** Operators who have latched it since it was last clear, and are still there. */
  readonly #latchers = new Set<string>();
  readonly #heldGapMs: number;
  /** When motion was last requested since the release; `null` once the hand has let go. */
  #heldMs: number | null = null;
  /** When motion was last requested; `null` once the hand has let go. */
  #askedMs: number | null = null;

  constructor(letGoMs: number, heldGapMs = letGoMs) {
    this.#letGoMs = letGoMs;
    this.#heldGapMs = Math.max(letGoMs, heldGapMs);
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

  /** The message that tells every operator about it. */
  get state(): EstopState {
    const latch = this.#number;
    if (this.#by === null) return { type: 'estop', latched: false, latch };
    const state: EstopState = { type: 'estop', latched: true, by: this.#by, latch };
    return this.#holders.size === 0 ? state : { ...state, releasedAt: 'robot' };
  }

  /** Whether somebody has latched it, apart from the stops at the robot that hold it. */
  get isAsked(): boolean {
    return this.#isAsked;
  }

  /** Whether an operator is among those who latched it. */
  get ofOperator(): boolean {
    return this.#ofOperator;
  }

  /** The stops at the robot that hold it, and that alone can let it go. */
  get holders(): ReadonlySet<RobotStop> {
    return this.#holders;
  }

  /** The operators who latched it and have neither withdrawn that nor left. */
  get latchers(): ReadonlySet<string> {
    return this.#latchers;
  }

  /** @returns false if it was already latched: its number has changed nevertheless */
  latch(by: EstopSource, operatorId?: string): boolean {
    this.#isAsked = true;
    this.#ofOperator ||= by === 'operator';
    // The bound is never met: a robot takes fewer operators.
    if (operatorId !== undefined && this.#latchers.size < MOST_LATCHERS) this.#latchers.add(operatorId);
    return this.#latch(by);
  }

  /**
   * Latches it from the robot's own side, until {@link letGo} with the same name.
   *
   * @returns false if this stop held it already
   */
  hold(stop: RobotStop): boolean {
    if (this.#holders.has(stop)) return false;
    this.#holders.add(stop);
    this.#latch('robot');
    return true;
  }

  /**
   * The stop at the robot holds it no longer. It stays latched if another holds it, or if somebody has latched it too.
   *
   * @returns false if this stop did not hold it
   */
  letGo(stop: RobotStop, nowMs: number): boolean {
    if (!this.#holders.delete(stop)) return false;
    if (this.#holders.size > 0) return true;
    if (this.#isAsked) this.#by = this.#ofOperator ? 'operator' : 'robot';
    else this.#clear(nowMs);
    return true;
  }

  /** The operator has left, or wants its own latch released. It stays latched. */
  withdraw(operatorId: string): void {
    this.#latchers.delete(operatorId);
  }

  /** The caller has checked who asks. @returns false if it was not latched, or is held by a stop at the robot */
  release(nowMs: number): boolean {
    if (this.#by === null || this.#holders.size > 0) return false;
    this.#clear(nowMs);
    return true;
  }

  /** Records a request of the lease holder and returns the answer to it. */
  meet(motion: boolean, nowMs: number): EstopAnswer {
    const askedMs = this.#askedMs;
    this.#askedMs = motion ? nowMs : null;
    if (this.#by !== null) return 'latched';
    if (this.#heldMs === null) return 'clear';
    const holds = askedMs !== null && nowMs - askedMs < this.#heldGapMs;
    if (!motion || (!holds && nowMs - this.#heldMs >= this.#letGoMs)) {
      this.#heldMs = null;
      return 'clear';
    }
    this.#heldMs = nowMs;
    return 'let-go';
  }

  /** Another operator drives: what the last one's hand asked for says nothing of it. */
  changeHand(): void {
    this.#askedMs = null;
  }

  #latch(by: EstopSource): boolean {
    this.#number = (this.#number + 1) >>> 0;
    if (this.#by !== null) return false;
    this.#by = by;
    this.#heldMs = null;
    return true;
  }

  #clear(nowMs: number): void {
    this.#by = null;
    this.#isAsked = false;
    this.#ofOperator = false;
    this.#latchers.clear();
    this.#heldMs = nowMs;
  }
}
