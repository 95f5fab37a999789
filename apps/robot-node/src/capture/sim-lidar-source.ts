import { officeWorld, SimulatedLidar } from '@farpoint/sim';
import { SharedWorld } from '../base/shared-snapshot.ts';
import type {
  CaptureRoom,
  CaptureWishes,
  FrameSource,
  SourceDescription,
  SourceFrame,
} from './frame-source.ts';
import { STANDING } from './playback-source.ts';

export interface SimLidarSourceOptions {
  seed: number;
  /** The base's thread writes the world here. If undefined, the robot stays at its start and nothing moves. */
  snapshot?: SharedArrayBuffer | undefined;
}

/** Rotations per second. */
const TURNS_PER_SECOND = 10;

/** The simulated robot's LiDAR. */
export class SimLidarSource implements FrameSource {
  readonly description: SourceDescription;
  readonly state = STANDING;
  readonly #lidar: SimulatedLidar;
  readonly #world: SharedWorld;

  private constructor(lidar: SimulatedLidar, world: SharedWorld) {
    this.#lidar = lidar;
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

  static async create({ seed, snapshot }: SimLidarSourceOptions): Promise<SimLidarSource> {
    const world = officeWorld();
    return new SimLidarSource(await SimulatedLidar.create({ world, seed }), new SharedWorld(world, snapshot));
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
