import type { TimedBaseState } from '@farpoint/cloud-source';
import { bodyYaw, type Twist } from '@farpoint/protocol';
import { type MeasuredMotion, Odometry, type OdometryLimits } from '@farpoint/safety';

/** What the robot believes about where it is, from what its base reports. All that keeps it safe asks here. */
export class BaseOdometry {
  readonly #odometry: Odometry;
  readonly #isSimulated: boolean;
  #taken: TimedBaseState | null = null;

  /** @param isSimulated whether the base is simulated: then its state is exact, and was measured at its time. Others say when */
  constructor(limits: OdometryLimits, isSimulated: boolean) {
    this.#odometry = new Odometry(limits);
    this.#isSimulated = isSimulated;
  }

  /** Takes the newest of the base. @returns it, with a velocity that was estimated if nobody measures it */
  take(state: TimedBaseState): TimedBaseState {
    const { pose, twist, timeMs, measuredMs } = state;
    const yaw = bodyYaw(pose.orientation);
    const atMs = measuredMs === undefined && this.#isSimulated ? timeMs : (measuredMs ?? null);
    this.#odometry.measured({ x: pose.position.x, y: pose.position.y, yaw }, twist, atMs);
    this.#taken = twist === null ? { ...state, twist: this.#odometry.newest?.twist ?? null } : state;
    return this.#taken;
  }

  /** The velocity that the wheels are told from now on. A simulated base that does not move is blocked. */
  told(twist: Readonly<Twist>, nowMs: number): void {
    if (!this.#isSimulated) this.#odometry.told(twist, nowMs);
  }

  /** `null` while nobody can tell. */
  get newest(): MeasuredMotion | null {
    return this.#odometry.newest;
  }

  /** How often a pose has jumped, and when the last did, ms. */
  get jumps(): { count: number; lastMs: number } {
    return this.#odometry.jumps;
  }

  /**
   * What the base reports, as far as it is believed: `null` while nobody can tell where the robot is. Its velocity is
   * measured, estimated, or what the wheels were last told.
   */
  get believed(): TimedBaseState | null {
    const { newest, toldTwist } = this.#odometry;
    if (newest === null || this.#taken === null) return null;
    return this.#taken.twist === null ? { ...this.#taken, twist: toldTwist } : this.#taken;
  }
}
