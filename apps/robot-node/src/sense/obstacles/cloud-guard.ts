/** In a capture thread: every whole cloud becomes a grid of the floor, for the main thread's obstacle guard. */

import type { SourceDescription, SourceFrame } from '@farpoint/cloud-source';
import { compose, inverse, type Pose, rotationMatrix } from '@farpoint/protocol';
import { FLOOR_SLOPE } from '@farpoint/safety';
import { type Codec, CodecError, ObstacleGrid } from '@farpoint/wasm-codec';
import { monotonicMs } from '../../ground/clock.ts';
import { STATIC_CAMERA_POSE } from '../sources/playback-source.ts';
import { BlankFloor } from './blank-floor.ts';
import { type GridShape, SharedGridWriter } from './shared-grid.ts';

/** Plain data, so that it can be passed to the capture thread. Lengths in metres. */
export interface CloudGuardOptions {
  /** Where the grids go: {@link makeSharedGrid}. */
  memory: SharedArrayBuffer;
  shape: GridShape;
  /** The pose of the sensor's optical frame in base_link. */
  mount: Pose;
  /** Whether the clouds' poses come from odometry. */
  odometry: boolean;
  /** What is lower is floor; what is higher is passed under. */
  clearanceM: number;
  heightM: number;
  /** What is lower than this below the floor is no floor. */
  dropM: number;
  /** Whether floor that a camera should see and does not counts as missing. */
  blankIsMissing?: boolean;
}

/**
 * A ray this low over a cell shows that it is free, metres (docs/obstacle-guard.md). Chosen: what is lower
 * than the ray may be missed, and a higher one would free less far away. `pnpm bench guard-runs` counts
 * contacts.
 */
const LOW_RAY_M = 0.15;
/**
 * Share of the points that an obstacle as large as a cell would have, which make an obstacle.
 * `pnpm bench guard-runs` counts contacts and false stops.
 */
const ENOUGH = 0.1;
const [LEAST_POINTS, MOST_POINTS] = [2, 60];
/** Of a sensor without a lens: the solid angle that it sees, sr. */
const SOLID_ANGLE = 3;
const ORIGIN: Pose = { position: { x: 0, y: 0, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } };

export class CloudGuard implements Disposable {
  readonly #grid: ObstacleGrid;
  readonly #writer: SharedGridWriter;
  readonly #options: CloudGuardOptions;
  readonly #fromOptical: Pose;
  readonly #blankFloor: BlankFloor | null;
  /** The cell that base_link was in at the last cloud. */
  #last: readonly [number, number] | null = null;

  constructor(codec: Codec, source: SourceDescription, options: CloudGuardOptions) {
    const { camera, width, height, capacity } = source;
    const { shape, memory, mount, clearanceM, heightM, dropM } = options;
    const perSquareMetre = camera === null ? capacity / SOLID_ANGLE : Math.abs(camera.fx * camera.fy);
    const nearPoints = perSquareMetre * shape.cellM ** 2 * ENOUGH;
    this.#grid = new ObstacleGrid(codec, capacity, {
      ...shape,
      clearanceM,
      heightM,
      dropM,
      slope: FLOOR_SLOPE,
      lowRayM: LOW_RAY_M,
      confirm: false,
      nearPoints: Math.min(MOST_POINTS, Math.max(LEAST_POINTS, nearPoints)),
      leastPoints: LEAST_POINTS,
    });
    if (camera !== null) this.#grid.setCamera({ width, height }, camera);
    // Makes room now: later, a cloud may lie in the memory that would move.
    void this.#grid.points;
    this.#writer = new SharedGridWriter(memory, shape);
    this.#options = options;
    this.#fromOptical = inverse(mount);
    const looks = camera !== null && options.blankIsMissing === true;
    this.#blankFloor = looks ? new BlankFloor({ ...camera, width, height }, mount, shape) : null;
  }

  /** Judges a cloud and hands the grid on: around base_link if it is not known where that was. */
  take(frame: SourceFrame): void {
    const beganMs = monotonicMs();
    const { shape, odometry, mount } = this.#options;
    const { side, cellM } = shape;
    const known = odometry ? this.#baseOf(frame) : null;
    const placed = known !== null;
    const base = known ?? ORIGIN;
    // A robot on a ramp has its floor with it: only its heading counts.
    const { z, w } = base.orientation;
    const length = Math.hypot(z, w) || 1;
    const heading = { x: 0, y: 0, z: z / length, w: w / length };
    const cells = [Math.floor(base.position.x / cellM), Math.floor(base.position.y / cellM)] as const;
    const within = {
      x: base.position.x - cells[0] * cellM,
      y: base.position.y - cells[1] * cellM,
      z: 0,
    };
    const { position, orientation } = compose({ position: within, orientation: heading }, mount);
    const grid = this.#grid;
    if (frame.form === 'images') grid.depth.set(frame.depth);
    else grid.points.set(frame.points.subarray(0, frame.count * 4));
    grid.pose.set(rotationMatrix(orientation));
    grid.pose.set([position.x, position.y, position.z], 9);
    const last = this.#last ?? cells;
    this.#last = cells;
    const shift = [cells[0] - last[0], cells[1] - last[1]] as const;
    try {
      grid.look(frame.form === 'images' ? 'image' : { points: frame.count }, shift);
    } catch (error) {
      // A pose that is none: without a grid, the sensor counts as silent.
      if (error instanceof CodecError) return;
      throw error;
    }
    if (frame.form === 'images') {
      const yaw = 2 * Math.atan2(heading.z, heading.w);
      this.#blankFloor?.mark(frame.depth, { x: within.x, y: within.y, yaw }, grid.classes);
    }
    this.#writer.write({
      capturedAtMs: frame.capturedAtMs,
      placed,
      disputed: frame.base === 'disputed',
      classes: grid.classes,
      heights: grid.heights,
      firstX: cells[0] - side / 2,
      firstY: cells[1] - side / 2,
      tookMs: monotonicMs() - beganMs,
    });
  }

  #baseOf({ base, cameraPose }: SourceFrame): Pose | null {
    if (base !== undefined) return typeof base === 'string' ? null : base;
    return cameraPose === STATIC_CAMERA_POSE ? null : compose(cameraPose, this.#fromOptical);
  }

  [Symbol.dispose](): void {
    this.#grid[Symbol.dispose]();
  }
}
