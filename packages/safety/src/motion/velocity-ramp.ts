import { type Twist, zeroTwist } from '@farpoint/protocol';

/** How fast the velocity changes, configured to the base. */
export interface RampLimits {
  /** m/s². */
  accelerationMps2: number;
  /** Braking and slowing down as a driver expects it, m/s². */
  decelerationMps2: number;
  /** Braking when something is wrong, m/s². */
  emergencyMps2: number;
  /** Faster and slower alike, rad/s². */
  turnRadps2: number;
  /** Braking a turn when something is wrong, rad/s². */
  emergencyTurnRadps2: number;
}

/** The base ramps by itself. */
export const NO_RAMPS: Readonly<RampLimits> = Object.freeze({
  accelerationMps2: Number.POSITIVE_INFINITY,
  decelerationMps2: Number.POSITIVE_INFINITY,
  emergencyMps2: Number.POSITIVE_INFINITY,
  turnRadps2: Number.POSITIVE_INFINITY,
  emergencyTurnRadps2: Number.POSITIVE_INFINITY,
});

/** Leads the velocity to its target without steps. */
export class VelocityRamp {
  readonly #limits: Readonly<RampLimits>;
  readonly #staleMs: number;
  #linear = 0;
  #angular = 0;
  #atMs: number | null = null;

  /** @param staleMs wheels that are told nothing for this long stop by themselves */
  constructor(limits: RampLimits, staleMs: number) {
    this.#limits = Object.freeze({ ...limits });
    this.#staleMs = staleMs;
  }

  /** The velocity at `nowMs` on the way to the target, as a copy. @param urgent whether to brake as hard as allowed */
  step(target: Readonly<Twist>, urgent: boolean, nowMs: number): Twist {
    const elapsedMs = this.#atMs === null ? 0 : Math.max(0, nowMs - this.#atMs);
    this.#atMs = nowMs;
    // The wheels have stopped meanwhile: going on from here would be a jolt.
    if (elapsedMs > this.#staleMs) this.stop();
    const { accelerationMps2, decelerationMps2, emergencyMps2, turnRadps2, emergencyTurnRadps2 } =
      this.#limits;
    const s = elapsedMs / 1000;
    const fall = urgent ? Math.max(emergencyMps2, decelerationMps2) : decelerationMps2;
    const turnFall = urgent ? Math.max(emergencyTurnRadps2, turnRadps2) : turnRadps2;
    this.#linear = approach(this.#linear, target.linear.x, change(accelerationMps2, s), change(fall, s));
    this.#angular = approach(this.#angular, target.angular.z, change(turnRadps2, s), change(turnFall, s));
    const twist = zeroTwist();
    twist.linear.x = this.#linear;
    twist.angular.z = this.#angular;
    return twist;
  }

  /** Whether the velocity differs from this. */
  differs({ linear, angular }: Readonly<Twist>): boolean {
    return this.#linear !== linear.x || this.#angular !== angular.z;
  }

  /** Whether the velocity is zero. */
  get stands(): boolean {
    return this.#linear === 0 && this.#angular === 0;
  }

  /** Stands still at once. */
  stop(): void {
    this.#linear = 0;
    this.#angular = 0;
  }
}

/** 0 · ∞ is not a number, and a base that ramps by itself is told its target at once. */
function change(rate: number, seconds: number): number {
  return rate === Number.POSITIVE_INFINITY ? rate : rate * seconds;
}

/** At most `rise` away from zero, at most `fall` towards it. A change of direction stops at zero. */
function approach(current: number, target: number, rise: number, fall: number): number {
  const turns = current * target < 0;
  const slower = turns || Math.abs(target) < Math.abs(current);
  const atOnce = rise === Number.POSITIVE_INFINITY && fall === Number.POSITIVE_INFINITY;
  const goal = turns && !atOnce ? 0 : target;
  const most = slower ? fall : rise;
  const difference = goal - current;
  return Math.abs(difference) <= most ? goal + 0 : current + Math.sign(difference) * most;
}
