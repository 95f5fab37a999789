import type { DriveState, MotionState, ObstacleGuardState } from '@farpoint/protocol';
import type { BlindTravel, MotionSupervisor } from '@farpoint/safety';

/** What operators are told of the robot's motion. */
export class MotionStatus {
  readonly #motion: MotionSupervisor;
  readonly #blindTravel: BlindTravel | null;
  readonly #obstacleGuard: (() => ObstacleGuardState) | null;

  /** @param obstacleGuard whether the robot looks where it goes; `null` if it cannot */
  constructor(
    motion: MotionSupervisor,
    blindTravel: BlindTravel | null,
    obstacleGuard: (() => ObstacleGuardState) | null = null,
  ) {
    this.#motion = motion;
    this.#blindTravel = blindTravel;
    this.#obstacleGuard = obstacleGuard;
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
    const looks = seen === 'blind' && guard.leaseHolder === null ? 'on' : seen;
    return {
      factor,
      reasons,
      mostLinear: Math.min(guard.limits.maxLinear, mostMps),
      ...(ageMs === null ? {} : { viewAgeMs: Math.max(0, Math.round(ageMs)) }),
      ...(looks === undefined ? {} : { obstacleGuard: looks }),
    };
  }
}
