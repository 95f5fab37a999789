import { type Twist, zeroTwist } from '@farpoint/protocol';

/** How fast the velocity changes, configured to the base. */
export interface RampLimits {
  /** m/s². */
  accelerationMps2: number;
  /** Sideways, m/s²; left out: as forwards. */
  lateralAccelerationMps2?: number | undefined;
  /** Braking and slowing down as a driver expects it, m/s². */
  decelerationMps2: number;
  /**
   * Braking and slowing down sideways, m/s²; left out, or less than forwards: as forwards. All stopping distances are computed
   * with that, whatever the direction.
   */
  lateralDecelerationMps2?: number | undefined;
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
  #lateral = 0;
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
    const forwards = { rise: change(accelerationMps2, s), fall: change(fall, s) };
    const { lateralAccelerationMps2 = accelerationMps2, lateralDecelerationMps2 = 0 } = this.#limits;
    const sideways = {
      rise: change(lateralAccelerationMps2, s),
      fall: change(Math.max(fall, lateralDecelerationMps2), s),
    };
    [this.#linear, this.#lateral] = approachPlanar(
      { ...forwards, current: this.#linear, target: target.linear.x },
      { ...sideways, current: this.#lateral, target: target.linear.y },
    );
    this.#angular = approach(this.#angular, target.angular.z, change(turnRadps2, s), change(turnFall, s));
    const twist = zeroTwist();
    twist.linear.x = this.#linear;
    twist.linear.y = this.#lateral;
    twist.angular.z = this.#angular;
    return twist;
  }

  /** Whether the velocity differs from this. */
  differs({ linear, angular }: Readonly<Twist>): boolean {
    return this.#linear !== linear.x || this.#lateral !== linear.y || this.#angular !== angular.z;
  }

  /** Whether the velocity is zero. */
  get stands(): boolean {
    return this.#linear === 0 && this.#lateral === 0 && this.#angular === 0;
  }

  /** Stands still at once. */
  stop(): void {
    this.#linear = 0;
    this.#lateral = 0;
    this.#angular = 0;
  }
}

/** One axis of the planar velocity, and how much it may change in a step. */
interface Axis {
  current: number;
  target: number;
  rise: number;
  fall: number;
}

/**
 * Leads both axes of the planar velocity on.
 *
 * If both slow down, or neither does, the velocity goes straight to its target: a robot that brakes keeps its direction, so that
 * it stops on the way that its guards have looked at, and no axis outlasts the other. If one slows down while the other does
 * not, it slows down as fast as it may, whatever the other does. The velocity never exceeds both what it was and its target.
 */
function approachPlanar(x: Axis, y: Axis): [x: number, y: number] {
  if (y.current === 0 && y.target === 0) return [approach(x.current, x.target, x.rise, x.fall), 0];
  const [to, side] = [stepOf(x), stepOf(y)];
  if (to.slower === side.slower) {
    const share = Math.min(shareOf(x, to), shareOf(y, side));
    return [between(x.current, to.goal, share), between(y.current, side.goal, share)];
  }
  const most = Math.max(Math.hypot(x.current, y.current), Math.hypot(to.goal, side.goal));
  if (to.slower) {
    const fallen = approach(x.current, x.target, x.rise, x.fall);
    return [fallen, riseWithin(y, fallen === to.goal ? Number.POSITIVE_INFINITY : beside(most, fallen))];
  }
  const fallen = approach(y.current, y.target, y.rise, y.fall);
  return [riseWithin(x, fallen === side.goal ? Number.POSITIVE_INFINITY : beside(most, fallen)), fallen];
}

/** What is left of a speed for one axis beside the other. */
function beside(speed: number, other: number): number {
  return Math.sqrt(Math.max(0, speed * speed - other * other));
}

function riseWithin({ current, target, rise, fall }: Axis, most: number): number {
  const risen = approach(current, target, rise, fall);
  return Math.sign(risen) * Math.min(Math.abs(risen), Math.max(most, Math.abs(current))) + 0;
}

function shareOf({ current }: Axis, { goal, most }: AxisStep): number {
  return goal === current ? 1 : Math.min(1, most / Math.abs(goal - current));
}

function between(from: number, to: number, share: number): number {
  return share === 1 ? to + 0 : from + (to - from) * share;
}

/** 0 · ∞ is not a number, and a base that ramps by itself is told its target at once. */
function change(rate: number, seconds: number): number {
  return rate === Number.POSITIVE_INFINITY ? rate : rate * seconds;
}

/** At most `rise` away from zero, at most `fall` towards it. A change of direction stops at zero. */
function approach(current: number, target: number, rise: number, fall: number): number {
  const { goal, most } = stepOf({ current, target, rise, fall });
  const difference = goal - current;
  return Math.abs(difference) <= most ? goal + 0 : current + Math.sign(difference) * most;
}

interface AxisStep {
  /** Whether the axis slows down. */
  slower: boolean;
  /** Where the step leads: the target, or zero on the way to the other direction. */
  goal: number;
  /** By how much the axis may change. */
  most: number;
}

function stepOf({ current, target, rise, fall }: Axis): AxisStep {
  const turns = current * target < 0;
  const slower = turns || Math.abs(target) < Math.abs(current);
  const atOnce = rise === Number.POSITIVE_INFINITY && fall === Number.POSITIVE_INFINITY;
  return { slower, goal: turns && !atOnce ? 0 : target, most: slower ? fall : rise };
}
