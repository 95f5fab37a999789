/** In the guard's own thread: every laser scan becomes a grid of the floor, for the main thread's obstacle guard. */
import type { Pose } from '@farpoint/protocol';
import { laserScanSchema, stampNs } from '@farpoint/ros';
import { type FloorPose, type PoseTrack, ScanGrid } from '@farpoint/safety';
import type { RosClock } from '../../ground/ros/capture-time.ts';
import { StampClock, stampRefusals } from '../../ground/ros/stamp-clock.ts';
import { bodyMount, mountDispute, type SensorMount } from '../sources/sensor-mount.ts';
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

/**
 * A sweep that is said to take longer is not straightened, s. Chosen: scanners turn 5 to 50 times a second,
 * so it is a mistake of the driver.
 */
const LONGEST_SWEEP_S = 1;
/** Says where a frame sits on the robot at a time, ms, as far as something other than the configuration knows. */
export type Placing = (frameId: string, atMs: number) => Pose | null;

const UNPLACED: Placing = () => null;
const HERE: FloorPose = { x: 0, y: 0, yaw: 0 };

export class ScanGuard {
  readonly #options: ScanGuardOptions;
  readonly #mount: Pose;
  readonly #poses: PoseTrack;
  readonly #placing: Placing;
  readonly #clock: RosClock;
  readonly #stamps: StampClock;
  readonly #grid: ScanGrid;
  readonly #writer: SharedGridWriter;

  /** @param poses where base_link was; not read without odometry @param placing must agree with the configured mount */
  constructor(options: ScanGuardOptions, poses: PoseTrack, clock: RosClock, placing: Placing = UNPLACED) {
    const { shape, clearanceM, heightM, memory } = options;
    const mount = bodyMount(options.mount);
    this.#options = options;
    this.#mount = mount;
    this.#placing = placing;
    this.#poses = poses;
    this.#clock = clock;
    this.#stamps = new StampClock(clock);
    this.#grid = new ScanGrid({ ...shape, mount, clearanceM, heightM });
    this.#writer = new SharedGridWriter(memory, shape);
  }

  /**
   * Judges a message and hands the grid on. A scan without any measurement, one that came before, and one of which nobody
   * knows where it was taken give none: without grids, the scanner counts as silent. If it is told to sit elsewhere than
   * configured, the grid says so and nothing else.
   *
   * @param receivedMs robot's clock @throws {Error} if it is no valid scan, its stamp is refused, or its place is disputed
   */
  take(message: unknown, receivedMs: number): void {
    const scan = laserScanSchema.parse(message);
    const capturedAtMs = this.#stamps.inOrder('', stampNs(scan.header.stamp), receivedMs);
    if (capturedAtMs === 'repeated') return;
    if (typeof capturedAtMs === 'string') throw new Error(stampRefusals[capturedAtMs]);
    const beganMs = this.#clock.now();
    this.#checkPlace(scan.header.frame_id, capturedAtMs);
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
        angleMin: scan.angle_min,
        angleIncrement: scan.angle_increment,
        rangeMin: scan.range_min,
        rangeMax: scan.range_max,
        ranges: scan.ranges,
      },
      inGrid(from),
      inGrid({ ...to, yaw: from.yaw + turn }),
    );
    if (valid > 0) this.#write(i, j, { capturedAtMs, tookMs: this.#clock.now() - beganMs });
  }

  #checkPlace(frameId: string, capturedAtMs: number): void {
    const told = this.#placing(frameId, capturedAtMs);
    const dispute = told === null ? null : mountDispute(this.#mount, told);
    if (dispute === null) return;
    this.#write(0, 0, { capturedAtMs, tookMs: 0, disputed: true });
    throw new Error(
      `guard.scans and tf disagree about where ${frameId} sits, by ${dispute}: correct one of them`,
    );
  }

  /** @param i,j the cell in its middle */
  #write(i: number, j: number, grid: { capturedAtMs: number; tookMs: number; disputed?: boolean }): void {
    const { odometry, shape } = this.#options;
    const { classes } = this.#grid;
    const half = shape.side / 2;
    this.#writer.write({ ...grid, placed: odometry, classes, firstX: i - half, firstY: j - half });
  }
}
