/** In the guard's own thread: every laser scan becomes a grid of the floor, for the main thread's obstacle guard. */
import { laserScanSchema, stampNs } from '@farpoint/ros';
import { type FloorPose, type PoseTrack, ScanGrid } from '@farpoint/safety';
import type { RosClock } from '../ros/capture-time.ts';
import { StampClock, stampRefusals } from '../ros/stamp-clock.ts';
import { bodyMount, type SensorMount } from './sensor-mount.ts';
import { type GridShape, SharedGridWriter } from './shared-grid.ts';

/** Plain data, so that it can be passed to the thread. Lengths in metres. */
export interface ScanGuardOptions {
  /** Where the grids go. */
  memory: SharedArrayBuffer;
  shape: GridShape;
  /** The scanner's frame in base_link. */
  mount: SensorMount;
  /** Whether odometry says where the robot is. */
  odometry: boolean;
  clearanceM: number;
  heightM: number;
}

/** A sweep that is said to take longer is not straightened, s. */
const LONGEST_SWEEP_S = 1;
const HERE: FloorPose = { x: 0, y: 0, yaw: 0 };

export class ScanGuard {
  readonly #options: ScanGuardOptions;
  readonly #poses: PoseTrack;
  readonly #clock: RosClock;
  readonly #stamps: StampClock;
  readonly #grid: ScanGrid;
  readonly #writer: SharedGridWriter;

  /** @param poses where base_link was; not read without odometry */
  constructor(options: ScanGuardOptions, poses: PoseTrack, clock: RosClock) {
    const { shape, mount, clearanceM, heightM, memory } = options;
    this.#options = options;
    this.#poses = poses;
    this.#clock = clock;
    this.#stamps = new StampClock(clock);
    this.#grid = new ScanGrid({ ...shape, mount: bodyMount(mount), clearanceM, heightM });
    this.#writer = new SharedGridWriter(memory, shape);
  }

  /**
   * Judges a message and hands the grid on. A scan without any measurement, one that came before, and one of which nobody
   * knows where it was taken give none: without grids, the scanner counts as silent.
   *
   * @param receivedMs robot's clock @throws {Error} if it is no valid scan, or its stamp is refused
   */
  take(message: unknown, receivedMs: number): void {
    const scan = laserScanSchema.parse(message);
    const capturedAtMs = this.#stamps.inOrder('', stampNs(scan.header.stamp), receivedMs);
    if (capturedAtMs === 'repeated') return;
    if (typeof capturedAtMs === 'string') throw new Error(stampRefusals[capturedAtMs]);
    const beganMs = this.#clock.now();
    const { odometry, shape } = this.#options;
    const sweepS = scan.time_increment * (scan.ranges.length - 1);
    const sweepMs = sweepS > 0 && sweepS <= LONGEST_SWEEP_S ? sweepS * 1000 : 0;
    const from = odometry ? this.#poses.at(capturedAtMs) : HERE;
    const to = odometry ? this.#poses.at(capturedAtMs + sweepMs) : HERE;
    if (from === null || to === null) return;
    const [i, j] = [Math.floor(from.x / shape.cellM), Math.floor(from.y / shape.cellM)];
    const inGrid = (pose: FloorPose): FloorPose => ({
      x: pose.x - i * shape.cellM,
      y: pose.y - j * shape.cellM,
      yaw: pose.yaw,
    });
    // The short way round.
    const turn = Math.atan2(Math.sin(to.yaw - from.yaw), Math.cos(to.yaw - from.yaw));
    const valid = this.#grid.look(
      {
        ...{ angleMin: scan.angle_min, angleIncrement: scan.angle_increment },
        ...{ rangeMin: scan.range_min, rangeMax: scan.range_max, ranges: scan.ranges },
      },
      inGrid(from),
      inGrid({ ...to, yaw: from.yaw + turn }),
    );
    if (valid === 0) return;
    this.#writer.write({
      ...{ capturedAtMs, placed: odometry, classes: this.#grid.classes },
      ...{ firstX: i - shape.side / 2, firstY: j - shape.side / 2 },
      tookMs: this.#clock.now() - beganMs,
    });
  }
}
