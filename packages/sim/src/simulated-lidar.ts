import { compose, OPTICAL_IN_BODY, type Pose } from '@farpoint/protocol';
import type { WasmSource } from './camera.ts';
import { SimulatedCamera } from './simulated-camera.ts';
import type { WorldDescription } from './world.ts';
import { basePose, type WorldSnapshot } from './world-snapshot.ts';

export interface LidarOptions {
  /** Number of beams, one above the other. */
  rings: number;
  /** Measurements of each beam per revolution. */
  columns: number;
  /** Angle between the lowest and the highest beam, radians, half of it above the horizon. */
  verticalFieldOfView: number;
  /** Height above base_link, metres. */
  up: number;
  /** Standard deviation of a range, metres. */
  noise: number;
  /** Longer ranges are not measured, metres. */
  far: number;
}

/** A small spinning LiDAR as carried by robots of this size. */
export const DEFAULT_LIDAR: Readonly<LidarOptions> = {
  rings: 16,
  columns: 900,
  verticalFieldOfView: Math.PI / 6,
  up: 1.1,
  noise: 0.01,
  far: 30,
};

/** One revolution. The points are a view that the next revolution overwrites. */
export interface LidarTurn {
  /** x, y, z in metres in the optical frame (z forward, x right, y down), NaN if nothing was hit; then R, G, B, 255. */
  points: Float32Array;
  /** Pose of the LiDAR's frame in the world, with optical axes. */
  pose: Pose;
  /** Simulated seconds. */
  captureTime: number;
}

/** Number of cameras, which together cover the full circle. */
const VIEWS = 3;
const VIEW_FIELD = (2 * Math.PI) / VIEWS;
/** Slightly more, so that the outermost beams also meet pixels. */
const CAMERA_FIELD = VIEW_FIELD + Math.PI / 90;
/** Pixels across a view: finer than the beams, so that each beam meets a pixel of its own. */
const VIEW_WIDTH = 640;

/** Where a beam meets a view. */
interface Beam {
  view: number;
  pixel: number;
  /** Components of the range vector, per metre of depth along the view's axis. */
  x: number;
  y: number;
  z: number;
}

/**
 * A spinning LiDAR on the base, rendered by depth cameras that cover the full circle: each beam takes the depth of the
 * pixel that it meets. A revolution is taken at one instant, so points need no motion correction. The same seed and
 * snapshots give the same revolutions.
 */
export class SimulatedLidar {
  readonly options: Readonly<LidarOptions>;
  readonly #views: readonly SimulatedCamera[];
  readonly #beams: readonly Beam[];
  readonly #points: Float32Array;
  readonly #words: Uint32Array;
  readonly #mount: Pose;
  #noiseState: number;

  private constructor(views: readonly SimulatedCamera[], options: LidarOptions, seed: number) {
    this.options = options;
    this.#views = views;
    this.#beams = beamsOf(options, views);
    this.#points = new Float32Array(this.#beams.length * 4);
    this.#words = new Uint32Array(this.#points.buffer);
    this.#mount = { position: { x: 0, y: 0, z: options.up }, orientation: OPTICAL_IN_BODY };
    this.#noiseState = (seed ^ 0x9e3779b9) >>> 0 || 1;
  }

  /** @throws SimulationError for an invalid seed or world */
  static async create(
    { world, seed, wasm }: { world: WorldDescription; seed: number; wasm?: WasmSource | undefined },
    given: Partial<LidarOptions> = {},
  ): Promise<SimulatedLidar> {
    const options = { ...DEFAULT_LIDAR, ...given };
    const views: SimulatedCamera[] = [];
    for (let i = 0; i < VIEWS; i++) {
      const camera = {
        width: VIEW_WIDTH,
        height: viewHeight(options.verticalFieldOfView),
        fieldOfView: CAMERA_FIELD,
        forward: 0,
        up: options.up,
        pitch: 0,
        yaw: i * VIEW_FIELD,
        near: 0.1,
        far: options.far,
        colourNoise: 0 as const,
      };
      views.push(await SimulatedCamera.create({ world, seed, camera, wasm }));
    }
    return new SimulatedLidar(views, options, seed);
  }

  /** Of the rings from the lowest to the highest, radians. */
  get elevations(): number[] {
    const { rings } = this.options;
    return Array.from({ length: rings }, (_, ring) => elevationOf(ring, this.options));
  }

  get capacity(): number {
    return this.#beams.length;
  }

  /** Scans one revolution of the world as described by the snapshot. */
  turn(snapshot: WorldSnapshot): LidarTurn {
    const images = this.#views.map((view) => view.render(snapshot, { groundTruth: true, points: false }));
    const { far, noise } = this.options;
    const points = this.#points;
    this.#beams.forEach(({ view, pixel, x, y, z }, i) => {
      const { depth, colour } = images[view]!;
      const along = depth[pixel]!;
      const range = along * Math.hypot(x, y, z);
      const at = i * 4;
      if (!(along > 0) || range > far) {
        points.fill(Number.NaN, at, at + 3);
      } else {
        const noisy = along * (1 + (this.#gaussian() * noise) / range);
        points[at] = x * noisy;
        points[at + 1] = y * noisy;
        points[at + 2] = z * noisy;
      }
      const [r, g, b] = [colour[pixel * 4]!, colour[pixel * 4 + 1]!, colour[pixel * 4 + 2]!];
      this.#words[at + 3] = (0xff000000 | (b << 16) | (g << 8) | r) >>> 0;
    });
    return { points, pose: compose(basePose(snapshot), this.#mount), captureTime: snapshot.time };
  }

  /** Frees the views' memory; it must not be used afterwards. */
  close(): void {
    for (const view of this.#views) view.close();
  }

  /** Approximately normal, deviation 1: the sum of four uniform numbers. */
  #gaussian(): number {
    let sum = 0;
    for (let i = 0; i < 4; i++) {
      // Marsaglia's xorshift, 32 bits.
      this.#noiseState ^= this.#noiseState << 13;
      this.#noiseState ^= this.#noiseState >>> 17;
      this.#noiseState ^= this.#noiseState << 5;
      sum += (this.#noiseState >>> 0) / 0x1_0000_0000 - 0.5;
    }
    return sum * Math.sqrt(3);
  }
}

/** Number of rows for the outermost beams even at a view's edge, where they are highest; a multiple of 4. */
function viewHeight(verticalFieldOfView: number): number {
  const focal = VIEW_WIDTH / 2 / Math.tan(CAMERA_FIELD / 2);
  return (
    Math.ceil(((2 * focal * Math.tan(verticalFieldOfView / 2)) / Math.cos(CAMERA_FIELD / 2) + 2) / 4) * 4
  );
}

function elevationOf(ring: number, options: Pick<LidarOptions, 'rings' | 'verticalFieldOfView'>): number {
  const { rings, verticalFieldOfView } = options;
  return rings === 1 ? 0 : verticalFieldOfView * (ring / (rings - 1) - 0.5);
}

function beamsOf(
  { rings, columns, verticalFieldOfView }: LidarOptions,
  views: readonly SimulatedCamera[],
): Beam[] {
  const beams: Beam[] = [];
  for (let ring = 0; ring < rings; ring++) {
    const elevation = elevationOf(ring, { rings, verticalFieldOfView });
    for (let column = 0; column < columns; column++) {
      // To the left, as in REP-103, from straight ahead.
      const azimuth = (2 * Math.PI * column) / columns;
      const view = Math.round(azimuth / VIEW_FIELD) % VIEWS;
      const { fx, fy, cx, cy, width } = views[view]!.intrinsics;
      const local = azimuth - view * VIEW_FIELD;
      // In the view's own optical frame, at depth 1.
      const right = -Math.tan(local);
      const down = -Math.tan(elevation) / Math.cos(local);
      const pixel = Math.round(cy + fy * down) * width + Math.round(cx + fx * right);
      // Rotated into the frame that looks ahead.
      const [c, s] = [Math.cos(view * VIEW_FIELD), Math.sin(view * VIEW_FIELD)];
      beams.push({ view, pixel, x: right * c - s, y: down, z: right * s + c });
    }
  }
  return beams;
}
