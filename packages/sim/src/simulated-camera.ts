import { type CameraIntrinsics, compose, multiply, OPTICAL_IN_BODY, type Pose } from '@farpoint/protocol';
import { type CameraOptions, type Images, StereoCamera, type WasmSource } from './camera.ts';
import { SimulationError } from './errors.ts';
import { type Part, STRIDE } from './figures.ts';
import { compileScene } from './scene.ts';
import { cos, fromYaw, sin } from './trigonometry.ts';
import type { WorldDescription } from './world.ts';
import { type BodyPlace, basePose, type WorldSnapshot } from './world-snapshot.ts';

export interface SimulatedCameraOptions {
  world: WorldDescription;
  /** Selects the noise: an integer from 0 to 2³² − 1. */
  seed: number;
  camera?: CameraOptions | undefined;
  /** The camera's module, if it cannot be read from this package's folder. */
  wasm?: WasmSource | undefined;
}

/** An organised cloud. The arrays are views that the next frame overwrites: copy what must last. */
export interface CloudFrame extends Images {
  width: number;
  height: number;
  intrinsics: Readonly<CameraIntrinsics>;
  /** Simulated time at which it was taken, seconds, and the camera's pose at that time. */
  captureTime: number;
  cameraPose: Pose;
  /** Counts from 0. */
  frameNumber: number;
}

export interface RenderOptions {
  /** Without noise and holes. */
  groundTruth?: boolean;
  /** False for images only, which is faster. */
  points?: boolean;
}

/** A depth camera on the base. The same seed and snapshots give the same frames, bit for bit. */
export class SimulatedCamera {
  readonly intrinsics: Readonly<CameraIntrinsics>;
  readonly #camera: StereoCamera;
  readonly #figures: { parts: Part[]; firstBody: number }[];
  readonly #mount: Pose;
  #frames = 0;

  private constructor(camera: StereoCamera, figures: { parts: Part[]; firstBody: number }[]) {
    this.#camera = camera;
    this.#figures = figures;
    this.intrinsics = camera.intrinsics;
    const { forward, left, up, pitch, yaw } = camera.options;
    const down = { x: 0, y: sin(pitch / 2), z: 0, w: cos(pitch / 2) };
    const level = multiply(down, OPTICAL_IN_BODY);
    const orientation = yaw === 0 ? level : multiply(fromYaw(yaw), level);
    this.#mount = { position: { x: forward, y: left, z: up }, orientation };
  }

  /** @throws SimulationError for an invalid seed, world or camera */
  static async create({ world, seed, camera, wasm }: SimulatedCameraOptions): Promise<SimulatedCamera> {
    if (!(Number.isInteger(seed) && seed >= 0 && seed <= 0xffffffff)) {
      throw new SimulationError('out-of-range', 'seed', `${seed} is not a whole number below 2^32`);
    }
    const scene = compileScene(world);
    return new SimulatedCamera(await StereoCamera.create(scene, seed, camera, wasm), scene.figures);
  }

  /** Pose of the optical frame in the world, with the base at `base`. */
  poseAt(base: Pose): Pose {
    return compose(base, this.#mount);
  }

  /** Renders the world as described by the snapshot. */
  render(snapshot: WorldSnapshot, { groundTruth = false, points = true }: RenderOptions = {}): CloudFrame {
    const cameraPose = this.poseAt(basePose(snapshot));
    this.#camera.setCameraPose(cameraPose);
    snapshot.bodies.forEach((body, i) => {
      this.#placeBody(body, this.#figures[i]!);
    });
    const frameNumber = this.#frames++;
    const images = this.#camera.render(frameNumber, groundTruth, points);
    const { width, height } = this.intrinsics;
    const { intrinsics } = this;
    return { ...images, width, height, intrinsics, captureTime: snapshot.time, cameraPose, frameNumber };
  }

  /** Frees the camera's memory; it must not be used afterwards. */
  close(): void {
    this.#camera.close();
  }

  #placeBody(
    { x, y, cos: c, sin: s, walked }: BodyPlace,
    figure: { parts: Part[]; firstBody: number },
  ): void {
    const gait = sin((2 * Math.PI * (walked % STRIDE)) / STRIDE);
    figure.parts.forEach(({ pivot, swing }, part) => {
      const [sc, ss] = [cos(swing * gait), sin(swing * gait)];
      // Yaw after the swing about y.
      const rotation = [c * sc, -s, c * ss, s * sc, c, s * ss, -ss, 0, sc];
      const [px, py] = [x + c * pivot.x - s * pivot.y, y + s * pivot.x + c * pivot.y];
      this.#camera.setBodyPose(figure.firstBody + part, rotation, px, py, pivot.z);
    });
  }
}
