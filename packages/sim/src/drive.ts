import { type Twist, zeroTwist } from '@farpoint/protocol';
import { requireFinite, SimulationError } from './errors.ts';

/** The limits of the base: m/s, rad/s, m/s², rad/s², metres. */
export interface RobotLimits {
  maxLinearSpeed: number;
  /** Sideways; 0: a differential drive. */
  maxLateralSpeed: number;
  maxAngularSpeed: number;
  linearAcceleration: number;
  /** Deceleration for braking and for lower speeds. */
  linearDeceleration: number;
  angularAcceleration: number;
  /** Radius of the round body. */
  radius: number;
  /** Distance between the two wheels, and their radius. */
  trackWidth: number;
  wheelRadius: number;
}

export const DEFAULT_LIMITS: Readonly<RobotLimits> = {
  maxLinearSpeed: 1.0,
  maxLateralSpeed: 0,
  maxAngularSpeed: 1.5,
  linearAcceleration: 1.0,
  linearDeceleration: 2.0,
  angularAcceleration: 3.0,
  radius: 0.25,
  trackWidth: 0.4,
  wheelRadius: 0.08,
};

/** Height of body and mast: higher obstacles do not stop the robot. */
export const ROBOT_HEIGHT = 1.0;
/** Lower obstacles are driven over. */
export const GROUND_CLEARANCE = 0.03;

/**
 * Follows the commanded velocity as fast as its limits allow: a differential drive, or a base that goes sideways as well. Sideways
 * it speeds up and brakes as forwards.
 */
export class BaseDrive {
  readonly limits: Readonly<RobotLimits>;
  /** Actual velocity of base_link, m/s and rad/s. */
  linear = 0;
  lateral = 0;
  angular = 0;
  #wantedLinear = 0;
  #wantedLateral = 0;
  #wantedAngular = 0;

  constructor(limits: Partial<RobotLimits> = {}) {
    this.limits = { ...DEFAULT_LIMITS, ...limits };
    for (const [name, value] of Object.entries(this.limits)) {
      const isRoom = requireFinite(value, `robot.${name}`) > 0 || (name === 'maxLateralSpeed' && value === 0);
      if (!isRoom) {
        throw new SimulationError('out-of-range', `robot.${name}`, `${value} is not above zero`);
      }
    }
  }

  /**
   * Commands linear.x, linear.y and angular.z, clamped to the limits; the base cannot follow the other components.
   *
   * @throws SimulationError `not-finite` if any component is not a finite number; the old command stays
   */
  command(twist: Twist): void {
    for (const part of ['linear', 'angular'] as const) {
      for (const axis of ['x', 'y', 'z'] as const) requireFinite(twist[part][axis], `twist.${part}.${axis}`);
    }
    const { maxLinearSpeed, maxLateralSpeed, maxAngularSpeed } = this.limits;
    this.#wantedLinear = clamp(twist.linear.x, maxLinearSpeed);
    this.#wantedLateral = clamp(twist.linear.y, maxLateralSpeed);
    this.#wantedAngular = clamp(twist.angular.z, maxAngularSpeed);
  }

  /** Changes the velocity over `dt` seconds. An unpowered base brakes. */
  step(dt: number, powered: boolean): void {
    const { linearAcceleration, linearDeceleration, angularAcceleration } = this.limits;
    const linear = powered ? this.#wantedLinear : 0;
    const lateral = powered ? this.#wantedLateral : 0;
    const angular = powered ? this.#wantedAngular : 0;
    this.linear = approach(this.linear, linear, linearAcceleration * dt, linearDeceleration * dt);
    this.lateral = approach(this.lateral, lateral, linearAcceleration * dt, linearDeceleration * dt);
    this.angular = approach(this.angular, angular, angularAcceleration * dt, angularAcceleration * dt);
  }

  get twist(): Twist {
    const twist = zeroTwist();
    twist.linear.x = this.linear;
    twist.linear.y = this.lateral;
    twist.angular.z = this.angular;
    return twist;
  }

  /** Along its way, m/s; negative backwards, where it does not go sideways. */
  get speed(): number {
    return this.lateral === 0 ? this.linear : Math.hypot(this.linear, this.lateral);
  }

  /** Stands still at once. */
  halt(): void {
    this.linear = 0;
    this.lateral = 0;
    this.angular = 0;
  }

  /** Angular speeds of the left and the right wheel, rad/s. */
  get wheelSpeeds(): { left: number; right: number } {
    const { trackWidth, wheelRadius } = this.limits;
    const turn = (this.angular * trackWidth) / 2;
    return { left: (this.linear - turn) / wheelRadius, right: (this.linear + turn) / wheelRadius };
  }
}

/** Moves `current` towards `target`: by at most `rise` away from zero, by at most `fall` towards it. */
export function approach(current: number, target: number, rise: number, fall: number): number {
  const turns = current * target < 0;
  const goal = turns ? 0 : target;
  const limit = Math.abs(goal) < Math.abs(current) ? fall : rise;
  const change = goal - current;
  return Math.abs(change) <= limit ? goal : current + Math.sign(change) * limit;
}

function clamp(value: number, limit: number): number {
  return Math.min(limit, Math.max(-limit, value));
}
