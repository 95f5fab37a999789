import type { EstopState, RobotStop } from '@farpoint/protocol';
import { Latchers } from './latchers.ts';

/** Who latched the emergency stop. */
export type EstopSource = 'operator' | 'robot';

/** `let-go`: released, but the hand has not let go of the stick since. */
export type EstopAnswer = 'clear' | 'latched' | 'let-go';

/**
 * The emergency stop: anyone can latch it, and only a deliberate action releases it. After the release, motion stays
 * refused until the hand has let go of the stick once and said so (a command for zero, or an open grip), because a reset must
 * not by itself start the machine (ISO 13850, 4.1.4). Silence says nothing: a hand may hold on through it.
 *
 * A stop at the robot itself, such as a button on it, *holds* it: while anything holds it, nothing else releases it.
 */
export class EstopLatch {
  #by: EstopSource | null = null;
  #number = 0;
  #ofOperator = false;
  #isAsked = false;
  /** The stops at the robot that hold it. */
  readonly #holders = new Set<RobotStop>();
  /** Operators who have latched it since it was last clear, and have not withdrawn that. */
  readonly latchers = new Latchers();
  /** Whether the driver's hand has yet to let go since the release. */
  #mustLetGo = false;

  get latched(): boolean {
    return this.#by !== null;
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

  /** @returns false if it was already latched: its number has changed nevertheless */
  latch(by: EstopSource, operatorId?: string): boolean {
    this.#isAsked = true;
    this.#ofOperator ||= by === 'operator';
    if (operatorId !== undefined) this.latchers.add(operatorId);
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
  letGo(stop: RobotStop): boolean {
    if (!this.#holders.delete(stop)) return false;
    if (this.#holders.size > 0) return true;
    if (this.#isAsked) this.#by = this.#ofOperator ? 'operator' : 'robot';
    else this.#clear();
    return true;
  }

  /** The caller has checked who asks. @returns false if it was not latched, or is held by a stop at the robot */
  release(): boolean {
    if (this.#by === null || this.#holders.size > 0) return false;
    this.#clear();
    return true;
  }

  /** Records a request of the lease holder and returns the answer to it. @param motion false: its hand is open */
  meet(motion: boolean): EstopAnswer {
    if (this.#by !== null) return 'latched';
    if (!motion) this.#mustLetGo = false;
    return this.#mustLetGo ? 'let-go' : 'clear';
  }

  /** Another hand drives. It is asked by itself whether it is open: the last one's says nothing of it. */
  changeHand(): void {
    this.#mustLetGo = false;
  }

  #latch(by: EstopSource): boolean {
    this.#number = (this.#number + 1) >>> 0;
    if (this.#by !== null) return false;
    this.#by = by;
    this.#mustLetGo = false;
    return true;
  }

  #clear(): void {
    this.#by = null;
    this.#isAsked = false;
    this.#ofOperator = false;
    this.latchers.clear();
    this.#mustLetGo = true;
  }
}
