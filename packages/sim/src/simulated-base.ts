import type { Pose, Twist } from '@farpoint/protocol';
import { Battery, type BatteryState } from './battery.ts';
import { CollisionWorld, staticObstacles } from './collision.ts';
import { BaseDrive, type RobotLimits } from './drive.ts';
import { requireFinite, SimulationError } from './errors.ts';
import { Motor } from './motor.ts';
import { MovingBody } from './movers.ts';
import { cos, sin, wrapAngle } from './trigonometry.ts';
import type { WorldDescription } from './world.ts';
import { basePose, type WorldSnapshot } from './world-snapshot.ts';

/** Length of one internal step, seconds: 2 mm of travel at 1 m/s. */
export const TIME_STEP = 0.002;
const DOCK_REACH = 0.2;
/** Longer calls are refused, because they would block the process for too long. */
const MAX_SECONDS_PER_CALL = 600;

export interface BaseState {
  /** Simulated seconds since the start. */
  time: number;
  /** base_link in the world: on the floor, between the wheels. */
  pose: Pose;
  yaw: number;
  /** Actual velocity in base_link. */
  twist: Twist;
  /** Of the windings, °C. */
  motorCelsius: { left: number; right: number };
  /** Radians rotated since the start, and rad/s. */
  wheelAngles: { left: number; right: number };
  wheelSpeeds: { left: number; right: number };
  battery: BatteryState;
  /** Whether the robot touched something during the last `step`. */
  collision: boolean;
  /** Metres driven, in whatever direction. */
  odometryDistance: number;
}

/**
 * A wheeled base in a world of walls, furniture, people and carts. The same commands and steps give the same motion,
 * bit for bit. Reads no clock.
 */
export class SimulatedBase {
  readonly world: WorldDescription;
  readonly #drive: BaseDrive;
  readonly #battery: Battery;
  readonly #motors = { left: new Motor(), right: new Motor() };
  readonly #collisions: CollisionWorld;
  readonly #movers: MovingBody[];
  #steps = 0;
  #unspent = 0;
  #position: { x: number; y: number };
  #yaw: number;
  #wheelAngles = { left: 0, right: 0 };
  #distance = 0;
  #collision = false;

  /** @param charge of the battery at the start, 0 to 1 @throws SimulationError for an invalid world, limit or charge */
  constructor(world: WorldDescription, limits?: Partial<RobotLimits>, charge = 0.95) {
    this.world = world;
    if (!(charge >= 0 && charge <= 1))
      throw new SimulationError('out-of-range', 'charge', `${charge} is not between 0 and 1`);
    this.#battery = new Battery(charge);
    this.#drive = new BaseDrive(limits);
    this.#movers = world.movers.map((mover) => new MovingBody(mover));
    this.#collisions = new CollisionWorld(
      staticObstacles(world),
      this.#movers.map((body) => body.obstacle),
    );
    this.#position = { x: world.start.x, y: world.start.y };
    this.#yaw = world.start.yaw;
    if (this.clearance < 0) {
      throw new SimulationError('bad-world', 'start', 'the robot would stand in something');
    }
  }

  /**
   * Sets the commanded velocity, kept until the next call: linear.x, linear.y and angular.z, clamped to the limits.
   *
   * @throws SimulationError `not-finite`; the old command stays
   */
  setCommand(twist: Twist): void {
    this.#drive.command(twist);
  }

  /**
   * Lets time pass, in whole internal steps of 2 ms; the remainder counts towards the next call.
   *
   * @throws SimulationError for a duration that is not finite, negative or above ten minutes
   */
  step(seconds: number): void {
    requireFinite(seconds, 'step');
    if (seconds < 0 || seconds > MAX_SECONDS_PER_CALL) {
      throw new SimulationError(
        'out-of-range',
        'step',
        `${seconds} s is not between 0 and ${MAX_SECONDS_PER_CALL}`,
      );
    }
    this.#unspent += seconds;
    // A tiny bit more, so that 500 calls of 0.002 s are 500 steps.
    const steps = Math.floor(this.#unspent / TIME_STEP + 1e-6);
    this.#unspent -= steps * TIME_STEP;
    if (steps > 0) this.#collision = false;
    for (let i = 0; i < steps; i++) this.#advance();
  }

  #advance(): void {
    const drive = this.#drive;
    const before = drive.speed;
    for (const mover of this.#movers) mover.step(TIME_STEP, this.#position, drive.limits.radius);
    drive.step(TIME_STEP, !this.#battery.empty);

    // Along the chord of the arc: exact to third order in the step.
    const heading = this.#yaw + (drive.angular * TIME_STEP) / 2;
    const [c, s] = [cos(heading), sin(heading)];
    const [travel, aside] = [drive.linear * TIME_STEP, drive.lateral * TIME_STEP];
    const from = this.#position;
    const to = { x: from.x + travel * c - aside * s, y: from.y + travel * s + aside * c };
    const { x, y, contact } = this.#collisions.move(from, to, drive.limits.radius);
    if (contact) {
      this.#collision = true;
      // The remaining speed is the distance actually driven; contact never pushes.
      const [dx, dy] = [x - from.x, y - from.y];
      drive.linear = slowed(drive.linear, (dx * c + dy * s) / TIME_STEP);
      drive.lateral = slowed(drive.lateral, (dy * c - dx * s) / TIME_STEP);
    }
    this.#position = { x, y };
    this.#yaw = wrapAngle(this.#yaw + drive.angular * TIME_STEP);
    const wheels = drive.wheelSpeeds;
    this.#wheelAngles.left += wheels.left * TIME_STEP;
    this.#wheelAngles.right += wheels.right * TIME_STEP;
    this.#distance += Math.abs(drive.speed) * TIME_STEP;
    const acceleration = (drive.speed - before) / TIME_STEP;
    this.#motors.left.step(TIME_STEP, wheels.left * drive.limits.wheelRadius, acceleration);
    this.#motors.right.step(TIME_STEP, wheels.right * drive.limits.wheelRadius, acceleration);
    this.#battery.step(TIME_STEP, drive.speed, drive.angular, acceleration, this.#docked);
    this.#steps++;
  }

  get #docked(): boolean {
    const { dock } = this.world;
    if (!dock || Math.abs(this.#drive.speed) > 0.05) return false;
    const [dx, dy] = [dock.x - this.#position.x, dock.y - this.#position.y];
    return dx * dx + dy * dy < DOCK_REACH * DOCK_REACH;
  }

  /** Metres between the robot's edge and the nearest obstacle. */
  get clearance(): number {
    return this.clearanceAt(this.#position.x, this.#position.y);
  }

  /** The same for a robot that would stand at (x, y). */
  clearanceAt(x: number, y: number): number {
    return this.#collisions.clearance(x, y) - this.#drive.limits.radius;
  }

  /** Metres between the edge of a robot that would stand at (x, y) and the nearest hole in the floor; infinite without. */
  edgeAt(x: number, y: number): number {
    let nearest = Number.POSITIVE_INFINITY;
    for (const { fromX, toX, fromY, toY } of this.world.holes ?? []) {
      const [outX, outY] = [Math.max(fromX - x, x - toX), Math.max(fromY - y, y - toY)];
      const inside = Math.max(outX, outY);
      const distance = inside <= 0 ? inside : Math.hypot(Math.max(0, outX), Math.max(0, outY));
      nearest = Math.min(nearest, distance - this.#drive.limits.radius);
    }
    return nearest;
  }

  get state(): BaseState {
    return {
      time: this.#steps * TIME_STEP,
      pose: basePose({ ...this.#position, yaw: this.#yaw }),
      yaw: this.#yaw,
      twist: this.#drive.twist,
      motorCelsius: { left: this.#motors.left.celsius, right: this.#motors.right.celsius },
      wheelAngles: { ...this.#wheelAngles },
      wheelSpeeds: this.#drive.wheelSpeeds,
      battery: this.#battery.state,
      collision: this.#collision,
      odometryDistance: this.#distance,
    };
  }

  /** What sensors see now. */
  get snapshot(): WorldSnapshot {
    return {
      time: this.#steps * TIME_STEP,
      ...this.#position,
      yaw: this.#yaw,
      bodies: this.#movers.map(({ obstacle: { x, y, cos, sin }, walked }) => ({ x, y, cos, sin, walked })),
    };
  }

  /** Places the robot somewhere else, at rest. @throws SimulationError if it would overlap an obstacle */
  teleport(x: number, y: number, yaw: number): void {
    requireFinite(x, 'teleport.x');
    requireFinite(y, 'teleport.y');
    requireFinite(yaw, 'teleport.yaw');
    if (this.#collisions.clearance(x, y) < this.#drive.limits.radius) {
      throw new SimulationError('out-of-range', 'teleport', `(${x}, ${y}) is not free`);
    }
    this.#position = { x, y };
    this.#yaw = wrapAngle(yaw);
    this.#drive.halt();
  }

  /** Positions of people and carts. */
  get movers(): readonly { name: string; x: number; y: number; walking: boolean }[] {
    return this.#movers.map((body) => ({
      name: body.mover.name,
      x: body.obstacle.x,
      y: body.obstacle.y,
      walking: body.moving && body.mover.speed > 0,
    }));
  }
}

/** What is left of a speed of which only a part was driven. */
function slowed(speed: number, driven: number): number {
  return speed > 0 ? clamp(driven, 0, speed) : clamp(driven, speed, 0);
}

function clamp(value: number, low: number, high: number): number {
  return Math.min(high, Math.max(low, value));
}
