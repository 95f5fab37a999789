import { type CameraIntrinsics, compose, multiply, type Pose, type Twist } from '@farpoint/protocol';
import { Battery, type BatteryState } from './battery.ts';
import { type CameraOptions, type Images, StereoCamera, type WasmSource } from './camera.ts';
import { CollisionWorld, staticObstacles } from './collision.ts';
import { DifferentialDrive, type RobotLimits } from './drive.ts';
import { requireFinite, SimulationError } from './errors.ts';
import { type Part, STRIDE } from './figures.ts';
import { MovingBody } from './movers.ts';
import { BODY_TO_OPTICAL, fromYaw } from './quaternion.ts';
import { compileScene } from './scene.ts';
import { cos, sin, wrapAngle } from './trigonometry.ts';
import type { WorldDescription } from './world.ts';
import { officeWorld } from './worlds/office.ts';

/** Length of one internal step, seconds: 2 mm of travel at 1 m/s. */
export const TIME_STEP = 0.002;
const DOCK_REACH = 0.2;
/** A call may not ask for more than this; it would block the process for long. */
const MAX_SECONDS_PER_CALL = 600;

export interface SimulationOptions {
  /** Selects the noise: a whole number from 0 to 2³² − 1. */
  seed: number;
  /** Default: the office. */
  world?: WorldDescription;
  camera?: CameraOptions;
  robot?: Partial<RobotLimits>;
  /** The camera's module, where it cannot be read from this package's folder. */
  wasm?: WasmSource;
}

export interface RobotState {
  /** Simulated seconds since the start. */
  time: number;
  /** base_link in the world: on the floor, between the wheels. */
  pose: Pose;
  yaw: number;
  /** Actual velocity in base_link. */
  twist: Twist;
  /** Radians turned since the start, and rad/s. */
  wheelAngles: { left: number; right: number };
  wheelSpeeds: { left: number; right: number };
  battery: BatteryState;
  /** Whether the robot touched something during the last `step`. */
  collision: boolean;
  /** The camera's optical frame in the world. */
  cameraPose: Pose;
  /** Metres driven, forwards and backwards. */
  odometryDistance: number;
}

/** An organised cloud. The arrays are views that the next frame overwrites: copy what must last. */
export interface CloudFrame extends Images {
  width: number;
  height: number;
  intrinsics: Readonly<CameraIntrinsics>;
  /** Simulated seconds at which it was taken, and where the camera was then. */
  captureTime: number;
  cameraPose: Pose;
  /** Counts from 0. */
  frameNumber: number;
}

/**
 * A wheeled robot with a depth camera in a world of walls, furniture, people and carts. Same seed, same
 * commands, same steps: same frames, to the bit. No clock is read.
 */
export class Simulation {
  readonly world: WorldDescription;
  readonly intrinsics: Readonly<CameraIntrinsics>;
  readonly #drive: DifferentialDrive;
  readonly #battery = new Battery();
  readonly #collisions: CollisionWorld;
  readonly #movers: MovingBody[];
  readonly #figures: { parts: Part[]; firstBody: number }[];
  readonly #camera: StereoCamera;
  readonly #mount: Pose;
  #steps = 0;
  #unspent = 0;
  #frames = 0;
  #position: { x: number; y: number };
  #yaw: number;
  #wheelAngles = { left: 0, right: 0 };
  #distance = 0;
  #collision = false;

  private constructor(
    world: WorldDescription,
    drive: DifferentialDrive,
    camera: StereoCamera,
    figures: { parts: Part[]; firstBody: number }[],
  ) {
    this.world = world;
    this.#drive = drive;
    this.#camera = camera;
    this.#figures = figures;
    this.intrinsics = camera.intrinsics;
    this.#movers = world.movers.map((mover) => new MovingBody(mover));
    this.#collisions = new CollisionWorld(
      staticObstacles(world),
      this.#movers.map((body) => body.obstacle),
    );
    const { forward, up, pitch } = camera.options;
    const down = { x: 0, y: sin(pitch / 2), z: 0, w: cos(pitch / 2) };
    this.#mount = { position: { x: forward, y: 0, z: up }, orientation: multiply(down, BODY_TO_OPTICAL) };
    this.#position = { x: world.start.x, y: world.start.y };
    this.#yaw = world.start.yaw;
    if (this.clearance < 0)
      throw new SimulationError('bad-world', 'start', 'the robot would stand in something');
  }

  /**
   * @throws SimulationError for a seed, world, camera or robot that makes no sense
   */
  static async create(options: SimulationOptions): Promise<Simulation> {
    const { seed } = options;
    if (!(Number.isInteger(seed) && seed >= 0 && seed <= 0xffffffff)) {
      throw new SimulationError('out-of-range', 'seed', `${seed} is not a whole number below 2^32`);
    }
    const world = options.world ?? officeWorld();
    const drive = new DifferentialDrive(options.robot);
    const scene = compileScene(world);
    const camera = await StereoCamera.create(scene, seed, options.camera, options.wasm);
    return new Simulation(world, drive, camera, scene.figures);
  }

  /**
   * Sets the wanted velocity, kept until the next call: linear.x and angular.z, clamped to the limits.
   *
   * @throws SimulationError `not-finite`; the old command stays
   */
  setCommand(twist: Twist): void {
    this.#drive.command(twist);
  }

  /**
   * Lets time pass, in whole internal steps of 2 ms; what is left over counts towards the next call.
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
    // A hair more, so that 500 calls of 0.002 s are 500 steps.
    const steps = Math.floor(this.#unspent / TIME_STEP + 1e-6);
    this.#unspent -= steps * TIME_STEP;
    if (steps > 0) this.#collision = false;
    for (let i = 0; i < steps; i++) this.#advance();
  }

  #advance(): void {
    const drive = this.#drive;
    const before = drive.linear;
    for (const mover of this.#movers) mover.step(TIME_STEP, this.#position, drive.limits.radius);
    drive.step(TIME_STEP, !this.#battery.empty);

    // Along the chord of the arc: exact to third order in the step.
    const heading = this.#yaw + (drive.angular * TIME_STEP) / 2;
    const [c, s] = [cos(heading), sin(heading)];
    const travel = drive.linear * TIME_STEP;
    const from = this.#position;
    const to = { x: from.x + travel * c, y: from.y + travel * s };
    const { x, y, contact } = this.#collisions.move(from, to, drive.limits.radius);
    if (contact) {
      this.#collision = true;
      // What is left of the speed is what was driven; contact never pushes.
      const driven = ((x - from.x) * c + (y - from.y) * s) / TIME_STEP;
      drive.linear = drive.linear > 0 ? clamp(driven, 0, drive.linear) : clamp(driven, drive.linear, 0);
    }
    this.#position = { x, y };
    this.#yaw = wrapAngle(this.#yaw + drive.angular * TIME_STEP);
    const wheels = drive.wheelSpeeds;
    this.#wheelAngles.left += wheels.left * TIME_STEP;
    this.#wheelAngles.right += wheels.right * TIME_STEP;
    this.#distance += Math.abs(drive.linear) * TIME_STEP;
    const acceleration = (drive.linear - before) / TIME_STEP;
    this.#battery.step(TIME_STEP, drive.linear, drive.angular, acceleration, this.#docked);
    this.#steps++;
  }

  get #docked(): boolean {
    const { dock } = this.world;
    if (!dock || Math.abs(this.#drive.linear) > 0.05) return false;
    const [dx, dy] = [dock.x - this.#position.x, dock.y - this.#position.y];
    return dx * dx + dy * dy < DOCK_REACH * DOCK_REACH;
  }

  /** Metres between the robot's edge and the nearest obstacle. */
  get clearance(): number {
    return this.#collisions.clearance(this.#position.x, this.#position.y) - this.#drive.limits.radius;
  }

  get state(): RobotState {
    const pose = {
      position: { ...this.#position, z: 0 },
      orientation: fromYaw(this.#yaw),
    };
    return {
      time: this.#steps * TIME_STEP,
      pose,
      yaw: this.#yaw,
      twist: this.#drive.twist,
      wheelAngles: { ...this.#wheelAngles },
      wheelSpeeds: this.#drive.wheelSpeeds,
      battery: this.#battery.state,
      collision: this.#collision,
      cameraPose: compose(pose, this.#mount),
      odometryDistance: this.#distance,
    };
  }

  /** Puts the robot somewhere else, at rest. @throws SimulationError when it would stand in something */
  teleport(x: number, y: number, yaw: number): void {
    requireFinite(x, 'teleport.x');
    requireFinite(y, 'teleport.y');
    requireFinite(yaw, 'teleport.yaw');
    if (this.#collisions.clearance(x, y) < this.#drive.limits.radius) {
      throw new SimulationError('out-of-range', 'teleport', `(${x}, ${y}) is not free`);
    }
    this.#position = { x, y };
    this.#yaw = wrapAngle(yaw);
    this.#drive.linear = 0;
    this.#drive.angular = 0;
  }

  /** Where people and carts are. */
  get movers(): readonly { name: string; x: number; y: number; walking: boolean }[] {
    return this.#movers.map((body) => ({
      name: body.mover.name,
      x: body.obstacle.x,
      y: body.obstacle.y,
      walking: body.moving && body.mover.speed > 0,
    }));
  }

  /** Takes a picture now. With `groundTruth` it has neither noise nor holes; without `points` it is images only, which is quicker. */
  renderFrame({ groundTruth = false, points = true } = {}): CloudFrame {
    const { cameraPose, time } = this.state;
    this.#camera.setCameraPose(cameraPose);
    this.#movers.forEach((body, i) => {
      const { parts, firstBody } = this.#figures[i]!;
      const gait = sin((2 * Math.PI * (body.walked % STRIDE)) / STRIDE);
      const { x, y, cos: c, sin: s } = body.obstacle;
      parts.forEach(({ pivot, swing }, part) => {
        const [sc, ss] = [cos(swing * gait), sin(swing * gait)];
        // Yaw after the swing about y.
        const rotation = [c * sc, -s, c * ss, s * sc, c, s * ss, -ss, 0, sc];
        this.#camera.setBodyPose(
          firstBody + part,
          rotation,
          x + c * pivot.x - s * pivot.y,
          y + s * pivot.x + c * pivot.y,
          pivot.z,
        );
      });
    });
    const frameNumber = this.#frames++;
    const images = this.#camera.render(frameNumber, groundTruth, points);
    const { width, height } = this.intrinsics;
    return {
      ...images,
      width,
      height,
      intrinsics: this.intrinsics,
      captureTime: time,
      cameraPose,
      frameNumber,
    };
  }

  /** Frees the camera's memory; the simulation must not be used afterwards. */
  close(): void {
    this.#camera.close();
  }
}

function clamp(value: number, low: number, high: number): number {
  return Math.min(high, Math.max(low, value));
}
