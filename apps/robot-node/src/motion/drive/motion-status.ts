import type { DriveState, MotionState, ObstacleGuardState, ReturnState } from '@farpoint/protocol';
import type { BlindTravel, MotionSupervisor } from '@farpoint/safety';

/** What operators are told of the robot's motion. */
export class MotionStatus {
  readonly #motion: MotionSupervisor;
  readonly #blindTravel: BlindTravel | null;
  readonly #obstacleGuard: (() => ObstacleGuardState) | null;
  readonly #returns: (() => ReturnState | undefined) | null;

  /**
   * @param obstacleGuard whether the robot looks where it goes; `null` if it cannot
   * @param returns what it does without operators; `null`: nothing
   */
  constructor(
    motion: MotionSupervisor,
    blindTravel: BlindTravel | null,
    obstacleGuard: (() => ObstacleGuardState) | null = null,
    returns: (() => ReturnState | undefined) | null = null,
  ) {
    this.#motion = motion;
    this.#blindTravel = blindTravel;
    this.#obstacleGuard = obstacleGuard;
    this.#returns = returns;
  }

  /** @param contact whether the base touches an obstacle */
  drive(nowMs: number, contact: boolean): DriveState {
    const { guard, decision } = this.#motion;
    return guard.state(nowMs, contact || decision.factor === 0);
  }

  state(nowMs: number): MotionState {
    const { guard, decision } = this.#motion;
    const { factor, reasons } = decision;
    const mostMps = this.#blindTravel?.mostMps(nowMs) ?? Number.POSITIVE_INFINITY;
    const ageMs = guard.view.worstAgeMs(nowMs);
    // Clouds are judged while somebody drives.
    const seen = this.#obstacleGuard?.();
    const returns = this.#returns?.();
    const letGoFirst = guard.mustLetGo(nowMs);
    const looks = seen === 'blind' && guard.leaseHolder === null ? 'on' : seen;
    return {
      factor,
      reasons,
      mostLinear: Math.min(guard.limits.maxLinear, mostMps),
      ...(ageMs === null ? {} : { viewAgeMs: Math.max(0, Math.round(ageMs)) }),
      ...(letGoFirst ? { letGoFirst } : {}),
      ...(looks === undefined ? {} : { obstacleGuard: looks }),
      ...(returns === undefined ? {} : { return: returns }),
    };
  }
}
