import { type CameraIntrinsics, type Pose, rotationMatrix } from '@farpoint/protocol';
import { initSync, DepthCamera as Rasteriser } from '../wasm/farpoint_sim_camera.js';
import { requireFinite, SimulationError } from './errors.ts';
import type { CompiledScene } from './scene.ts';

export interface CameraOptions {
  /** Pixels, multiples of 4; default 480 × 480. */
  width?: number;
  height?: number;
  /** Horizontal field of view, radians; default 90°. */
  fieldOfView?: number;
  /** Position on the robot: metres ahead of, left of and above base_link, radians downwards, radians to the left. */
  forward?: number;
  left?: number;
  up?: number;
  pitch?: number;
  yaw?: number;
  /** Distance between the two imagers, metres. */
  baseline?: number;
  /** Standard deviation of depth at one metre, metres; it grows with the square of depth. */
  noise?: number;
  /** The matcher's disparity step, pixels; 0 for none. */
  disparityStep?: number;
  /** Depth outside this range, metres, is invalid. */
  near?: number;
  far?: number;
  /** Fraction of pixels lost as scattered speckle. */
  speckle?: number;
  /** Peak of the colour noise, in levels of 255. */
  colourNoise?: 0 | 1 | 3 | 7;
}

/** A stereo depth camera of the size and quality common on robots. */
export const DEFAULT_CAMERA: Readonly<Required<CameraOptions>> = {
  width: 480,
  height: 480,
  fieldOfView: Math.PI / 2,
  forward: 0.12,
  left: 0,
  up: 0.9,
  pitch: 0.2,
  yaw: 0,
  baseline: 0.075,
  noise: 0.0015,
  disparityStep: 1 / 32,
  near: 0.3,
  far: 15,
  speckle: 0.025,
  colourNoise: 1,
};

const FLOOR_CAMERA = {
  width: 128,
  height: 128,
  fieldOfView: 2,
  up: 0.5,
  pitch: 1,
  near: 0.1,
} as const satisfies CameraOptions;

/**
 * Two small wide depth cameras low on the robot, of which one looks at the floor before its wheels, the other behind them,
 * from the wheels to where {@link DEFAULT_CAMERA} sees it, or as far as a robot goes while it brakes.
 */
export const FLOOR_CAMERAS: Readonly<Record<'ahead' | 'behind', CameraOptions>> = {
  ahead: { ...FLOOR_CAMERA, forward: 0.1, yaw: 0 },
  behind: { ...FLOOR_CAMERA, forward: -0.1, yaw: Math.PI },
};

/** Views into the camera's memory, row by row; the next frame overwrites them. */
export interface Images {
  /**
   * x, y, z in metres in the optical frame, NaN where invalid; the fourth float's bits are R, G, B, 255. Empty if only
   * the images were requested.
   */
  points: Float32Array;
  /** R, G, B, 255: the plain picture of the same view. */
  colour: Uint8Array;
  /** Depth along z in metres, 0 where invalid. */
  depth: Float32Array;
}

/** How many numbers the rasteriser takes for a pose. */
const POSE_LENGTH = 12;

interface WasmMemory {
  readonly buffer: ArrayBuffer;
}

/** The module's bytes, or its compiled form. */
export type WasmSource = Uint8Array<ArrayBuffer> | ArrayBuffer;

let loading: Promise<WasmMemory> | undefined;

/** Starts the WASM module once; `source` is needed only if the file next to this one cannot be read. */
function loadRasteriser(source?: WasmSource): Promise<WasmMemory> {
  loading ??= (async () => {
    const bytes = source ?? (await readModule());
    return initSync({ module: bytes }).memory as WasmMemory;
  })().catch((error: unknown) => {
    loading = undefined;
    throw error;
  });
  return loading;
}

/** Imports Node's file system only here, because browsers pass the bytes. */
async function readModule(): Promise<WasmSource> {
  const { readFile } = await import('node:fs/promises');
  return readFile(new URL('../wasm/farpoint_sim_camera_bg.wasm', import.meta.url));
}

/** The simulated camera: takes poses, returns images. */
export class StereoCamera {
  readonly intrinsics: Readonly<CameraIntrinsics>;
  readonly options: Readonly<Required<CameraOptions>>;
  readonly #memory: WasmMemory;
  readonly #rasteriser: Rasteriser;
  #poses: Float64Array;
  #images: Images;

  private constructor(
    memory: WasmMemory,
    rasteriser: Rasteriser,
    intrinsics: CameraIntrinsics,
    options: Required<CameraOptions>,
  ) {
    this.#memory = memory;
    this.#rasteriser = rasteriser;
    this.intrinsics = intrinsics;
    this.options = options;
    this.#poses = this.#viewPoses();
    this.#images = this.#viewImages(false);
  }

  /** @throws SimulationError `bad-camera` if the rasteriser refuses the scene or the options */
  static async create(
    scene: CompiledScene,
    seed: number,
    given: CameraOptions = {},
    wasm?: WasmSource,
  ): Promise<StereoCamera> {
    const options = { ...DEFAULT_CAMERA, ...given };
    for (const [name, value] of Object.entries(options)) requireFinite(value, `camera.${name}`);
    const { fieldOfView, width, height } = options;
    if (!(fieldOfView > 0 && fieldOfView < Math.PI)) {
      throw new SimulationError(
        'out-of-range',
        'camera.fieldOfView',
        `${fieldOfView} rad is not between 0 and π`,
      );
    }
    // Uses the exact value of tan(π/4), so that the usual 90° gives the same bits in every engine.
    const tangent = fieldOfView === Math.PI / 2 ? 1 : Math.tan(fieldOfView / 2);
    const focal = width / 2 / tangent;
    const intrinsics = { width, height, fx: focal, fy: focal, cx: (width - 1) / 2, cy: (height - 1) / 2 };
    const memory = await loadRasteriser(wasm);
    const config = [
      width,
      height,
      focal,
      focal,
      intrinsics.cx,
      intrinsics.cy,
      options.baseline,
      options.noise,
      options.disparityStep,
      options.near,
      options.far,
      options.speckle,
      options.colourNoise,
      seed,
    ];
    try {
      const rasteriser = new Rasteriser(scene.numbers, Float64Array.from(config));
      return new StereoCamera(memory, rasteriser, intrinsics, options);
    } catch (error) {
      throw new SimulationError(
        'bad-camera',
        'camera',
        error instanceof Error ? error.message : String(error),
      );
    }
  }

  /** Sets the pose of the optical frame in the world for the next frame. */
  setCameraPose(pose: Pose): void {
    const { x, y, z } = pose.position;
    this.#write(0, rotationMatrix(pose.orientation), x, y, z);
  }

  /** Sets the pose of one of the scene's bodies (from 1) for the next frame. */
  setBodyPose(body: number, rotation: readonly number[], x: number, y: number, z: number): void {
    this.#write(body + 1, rotation, x, y, z);
  }

  /** Renders a frame. The same poses and number give the same bits. Ground truth has neither noise nor holes. */
  render(frameNumber: number, groundTruth: boolean, points: boolean): Images {
    this.#rasteriser.render(frameNumber, groundTruth, points);
    // Growing the memory (for the first points, or another camera) detaches older views.
    const hasPoints = this.#images.points.length > 0;
    if (this.#images.depth.buffer !== this.#memory.buffer || hasPoints !== points)
      this.#images = this.#viewImages(points);
    return this.#images;
  }

  /** Frees the camera's memory; it must not be used afterwards. */
  close(): void {
    this.#rasteriser.free();
  }

  #write(slot: number, rotation: readonly number[], x: number, y: number, z: number): void {
    if (this.#poses.buffer !== this.#memory.buffer) this.#poses = this.#viewPoses();
    const at = slot * POSE_LENGTH;
    for (let i = 0; i < 9; i++) this.#poses[at + i] = rotation[i]!;
    this.#poses[at + 9] = x;
    this.#poses[at + 10] = y;
    this.#poses[at + 11] = z;
  }

  #viewPoses(): Float64Array {
    const { buffer } = this.#memory;
    return new Float64Array(buffer, this.#rasteriser.posesPointer(), this.#rasteriser.posesLength());
  }

  #viewImages(points: boolean): Images {
    const { buffer } = this.#memory;
    const pixels = this.intrinsics.width * this.intrinsics.height;
    return {
      points: points
        ? new Float32Array(buffer, this.#rasteriser.pointsPointer(), 4 * pixels)
        : new Float32Array(0),
      colour: new Uint8Array(buffer, this.#rasteriser.colourPointer(), 4 * pixels),
      depth: new Float32Array(buffer, this.#rasteriser.depthPointer(), pixels),
    };
  }
}

/** Depth as many depth cameras send it: integer millimetres, 0 where invalid, saturating at 65.535 m. */
export function depthToMillimetres(depth: Float32Array, into = new Uint16Array(depth.length)): Uint16Array {
  for (let i = 0; i < depth.length; i++) into[i] = Math.min(65535, depth[i]! * 1000 + 0.5);
  return into;
}
