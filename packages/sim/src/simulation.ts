import type { CameraIntrinsics, Pose, Twist } from '@farpoint/protocol';
import type { CameraOptions, WasmSource } from './camera.ts';
import type { RobotLimits } from './drive.ts';
import { type BaseState, SimulatedBase } from './simulated-base.ts';
import { type CloudFrame, type RenderOptions, SimulatedCamera } from './simulated-camera.ts';
import type { WorldDescription } from './world.ts';
import { officeWorld } from './worlds/office.ts';

export interface SimulationOptions {
  /** Selects the noise: an integer from 0 to 2³² − 1. */
  seed: number;
  /** Default: the office. */
  world?: WorldDescription;
  camera?: CameraOptions;
  robot?: Partial<RobotLimits>;
  /** The camera's module, if it cannot be read from this package's folder. */
  wasm?: WasmSource;
}

export interface RobotState extends BaseState {
  /** Pose of the camera's optical frame in the world. */
  cameraPose: Pose;
}

/** Base and camera in a common place and time. The same seed, commands and steps give the same frames, bit for bit. */
export class Simulation {
  readonly base: SimulatedBase;
  readonly #camera: SimulatedCamera;

  private constructor(base: SimulatedBase, camera: SimulatedCamera) {
    this.base = base;
    this.#camera = camera;
  }

  /** @throws SimulationError for an invalid seed, world, camera or robot */
  static async create(options: SimulationOptions): Promise<Simulation> {
    const { seed, camera, wasm, robot, world = officeWorld() } = options;
    const base = new SimulatedBase(world, robot);
    return new Simulation(base, await SimulatedCamera.create({ world, seed, camera, wasm }));
  }

  get world(): WorldDescription {
    return this.base.world;
  }

  get intrinsics(): Readonly<CameraIntrinsics> {
    return this.#camera.intrinsics;
  }

  /** As {@link SimulatedBase.setCommand}. */
  setCommand(twist: Twist): void {
    this.base.setCommand(twist);
  }

  /** As {@link SimulatedBase.step}. */
  step(seconds: number): void {
    this.base.step(seconds);
  }

  get clearance(): number {
    return this.base.clearance;
  }

  get state(): RobotState {
    const { state } = this.base;
    return { ...state, cameraPose: this.#camera.poseAt(state.pose) };
  }

  /** As {@link SimulatedBase.teleport}. */
  teleport(x: number, y: number, yaw: number): void {
    this.base.teleport(x, y, yaw);
  }

  get movers(): SimulatedBase['movers'] {
    return this.base.movers;
  }

  /** Takes a picture now. */
  renderFrame(options?: RenderOptions): CloudFrame {
    return this.#camera.render(this.base.snapshot, options);
  }

  /** Frees the camera's memory; the simulation must not be used afterwards. */
  close(): void {
    this.#camera.close();
  }
}
