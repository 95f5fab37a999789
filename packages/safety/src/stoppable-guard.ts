import type { EstopCause, EstopState } from '@farpoint/protocol';
import { EstopLatch, type EstopSource } from './estop.ts';
import {
  type EstopReleaseOutcome,
  type EstopReleasePolicy,
  releaseEstop,
  releaseRule,
} from './estop-release.ts';
import type { RobotStop } from './robot-stop.ts';

/** The emergency stop's part of a {@link DriveGuard}. */
export abstract class StoppableGuard {
  protected readonly estop: EstopLatch;
  readonly #releasePolicy: EstopReleasePolicy;

  constructor(letGoMs: number, releasePolicy: EstopReleasePolicy) {
    this.estop = new EstopLatch(letGoMs);
    this.#releasePolicy = releasePolicy;
  }

  /** The operator that holds the lease. */
  abstract get leaseHolder(): string | null;

  /** Nothing that was wished until now counts any more. */
  protected abstract stopAtOnce(): void;

  /**
   * Stops at once, whoever asks and however often. Then send every operator the `estopState`: its `latch` has changed.
   *
   * @param operatorId the operator who asks, if it is one
   * @returns false if it was already latched
   */
  latchEstop(by: EstopSource, operatorId?: string): boolean {
    this.stopAtOnce();
    return this.estop.latch(by, operatorId);
  }

  /**
   * Only the lease holder or a supervisor can release it, within the policy (estop-release.ts). Motion then needs a new
   * command, from a hand that has let go (estop.ts).
   *
   * @param of number of the latch that is meant; left out, it is the present one
   */
  releaseEstop(operatorId: string, nowMs: number, supervises = false, of?: number): EstopReleaseOutcome {
    const holdsLease = this.leaseHolder === operatorId;
    return releaseEstop(this.estop, this.#releasePolicy, { operatorId, holdsLease, supervises, of }, nowMs);
  }

  /**
   * Stops at once, for a stop at the robot itself. Only {@link letGoEstop} with the same name takes that back. Then send
   * every operator the `estopState`.
   *
   * @returns false if it held the emergency stop already
   */
  holdEstop(stop: RobotStop): boolean {
    this.stopAtOnce();
    return this.estop.hold(stop);
  }

  /**
   * The stop at the robot was released. The emergency stop stays latched if anything else has latched it.
   *
   * @returns false if it did not hold the emergency stop
   */
  letGoEstop(stop: RobotStop, nowMs: number): boolean {
    return this.estop.letGo(stop, nowMs);
  }

  /** The stops at the robot that hold the emergency stop. */
  get estopHolders(): ReadonlySet<RobotStop> {
    return this.estop.holders;
  }

  /** The message that tells every operator about the emergency stop. */
  estopState(): EstopState {
    const { by, number: latch, holders } = this.estop;
    if (by === null) return { type: 'estop', latched: false, latch };
    const state: EstopState = { type: 'estop', latched: true, by, latch };
    return holders.size === 0 ? state : { ...state, releasedAt: 'robot' };
  }

  /** What of it this operator must know in order to release it; `null` while it is not latched. */
  estopCause(operatorId: string): Omit<EstopCause, 'pressedBy' | 'start'> | null {
    const { latched, number: latch, holders, latchers } = this.estop;
    if (!latched) return null;
    const held = holders.size === 0 ? {} : { heldBy: [...holders] };
    const release = releaseRule(this.estop, this.#releasePolicy);
    return { type: 'estopCause', latch, yours: latchers.has(operatorId), ...held, release };
  }

  /**
   * Whose emergency stop must outlive a restart: an operator's comes before the robot's. `null` while it is released,
   * and while only {@link estopHolders} keep it.
   */
  get estopKeptFor(): EstopSource | null {
    if (this.estop.ofOperator) return 'operator';
    return this.estop.isAsked ? 'robot' : null;
  }
}
