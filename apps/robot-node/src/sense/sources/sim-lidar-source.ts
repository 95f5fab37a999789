import type {
  CaptureRoom,
  CaptureWishes,
  FrameSource,
  SourceDescription,
  SourceFrame,
} from '@farpoint/cloud-source';
import { officeWorld, SimulatedLidar, type Thing, withThings } from '@farpoint/sim';
import { SharedWorld } from '../base/shared-snapshot.ts';
import { STANDING } from './playback-source.ts';

export interface SimLidarSourceOptions {
  seed: number;
  /** Which of the robot's LiDARs this is: each has its own height and noise. */
  index?: number;
  /** The base's thread writes the world here. If undefined, the robot stays at its start and nothing moves. */
  snapshot?: SharedArrayBuffer | undefined;
  /** Put into the world. */
  things?: readonly Thing[] | undefined;
}

/** Rotations per second. */
const TURNS_PER_SECOND = 10;

/** Where the robot's LiDARs sit, metres above base_link: the first on the mast, the others below it. */
const HEIGHTS = [1.1, 0.35, 0.7, 0.9, 0.5, 0.25, 1];

/** The height above base_link of the LiDAR with this index, metres. */
export function lidarHeight(index = 0): number {
  return HEIGHTS[index % HEIGHTS.length] as number;
}

/** A LiDAR of the simulated robot. */
export class SimLidarSource implements FrameSource {
  readonly description: SourceDescription;
  readonly state = STANDING;
  readonly rings: readonly number[];
  readonly #lidar: SimulatedLidar;
  readonly #world: SharedWorld;

  private constructor(lidar: SimulatedLidar, world: SharedWorld) {
    this.#lidar = lidar;
    this.rings = lidar.elevations;
    this.#world = world;
    this.description = {
      kind: 'simulated LiDAR',
      width: lidar.capacity,
      height: 1,
      capacity: lidar.capacity,
      camera: null,
      depthMeasure: 'range',
      framesPerSecond: TURNS_PER_SECOND,
    };
  }

  static async create({
    seed,
    index = 0,
    snapshot,
    things = [],
  }: SimLidarSourceOptions): Promise<SimLidarSource> {
    const world = withThings(officeWorld(), things);
    const lidar = await SimulatedLidar.create({ world, seed: seed + index }, { up: lidarHeight(index) });
    return new SimLidarSource(lidar, new SharedWorld(world, snapshot));
  }

  capture(nowMs: number, _wishes: CaptureWishes, room: CaptureRoom): SourceFrame {
    const { points, pose } = this.#lidar.turn(this.#world.newest);
    // Copied as words: copying a colour as a float may change the bits of a NaN.
    const into = new Uint32Array(room.points.buffer, room.points.byteOffset, points.length);
    into.set(new Uint32Array(points.buffer, points.byteOffset, points.length));
    const count = points.length / 4;
    return { form: 'points', points: room.points, count, cameraPose: pose, capturedAtMs: nowMs };
  }

  close(): void {
    this.#lidar.close();
  }
}
