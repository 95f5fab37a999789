import type { Twist } from '@farpoint/protocol';
import { FREE, type MotionBound, type MotionGuard } from './motion-guard.ts';

export interface CollisionDemandOptions {
  /** After this long without a message, the other program is silent, ms. */
  silentMs: number;
  /** Highest speed while it is silent, m/s; 0 stops. */
  silentMps: number;
  /** How far the footprint reaches from base_link, metres: a turn is as fast as its outline. */
  reachM: number;
}

/** What another program on the robot demands: as a rule, it watches a safety scanner or a bumper. */
export type CollisionState = 'free' | 'bounded' | 'silent';

/**
 * Bounds the robot's motion by what another program demands, for as long as it does. It does not latch: unlike after the
 * emergency stop, the robot moves on when the demand ends.
 */
export class CollisionDemand implements MotionGuard {
  readonly #options: CollisionDemandOptions;
  #mostMps = 0;
  #heardMs = Number.NEGATIVE_INFINITY;

  constructor(options: CollisionDemandOptions) {
    this.#options = options;
  }

  /**
   * It was heard.
   *
   * @param mostMps highest speed in any direction, m/s: 0 stops, infinity allows all. What is no number stops
   * @param atMs the robot's monotonic clock
   */
  hear(mostMps: number, atMs: number): void {
    if (!(atMs >= this.#heardMs)) return;
    this.#mostMps = Number.isNaN(mostMps) ? 0 : Math.max(0, mostMps);
    this.#heardMs = atMs;
  }

  /** Whoever demanded is gone: from now on, it is silent. */
  lose(): void {
    this.#heardMs = Number.NEGATIVE_INFINITY;
  }

  state(nowMs: number): CollisionState {
    if (!(nowMs - this.#heardMs <= this.#options.silentMs)) return 'silent';
    return this.#mostMps === Number.POSITIVE_INFINITY ? 'free' : 'bounded';
  }

  bound({ linear, angular }: Readonly<Twist>, nowMs: number): Readonly<MotionBound> {
    const { silentMps, reachM } = this.#options;
    const silent = this.state(nowMs) === 'silent';
    const most = silent ? silentMps : this.#mostMps;
    const pace = Math.max(Math.hypot(linear.x, linear.y), Math.abs(angular.z) * reachM);
    // A wish that is no number is fast. A stop is urgent also for a robot that was told to stand still and has not yet.
    if (pace <= most && most > 0) return FREE;
    const factor = Number.isFinite(pace) && most > 0 ? most / pace : 0;
    return { factor, reason: silent ? 'collision-silent' : 'collision-topic', urgent: factor === 0 };
  }
}
