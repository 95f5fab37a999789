import { type Battery, compose, type Pose, type Quaternion, type Twist, zeroTwist } from '@farpoint/protocol';
import {
  BATTERY_TYPES,
  batteryStateSchema,
  frameName,
  isFiniteVector,
  ODOMETRY_TYPES,
  odometrySchema,
  poseStampedSchema,
  stampNs,
  TF_TYPES,
  tfMessageSchema,
  unitQuaternion,
} from './messages.ts';
import type { CloudAxes } from './point-words.ts';
import { STATIC_SUFFIX } from './topic-table.ts';
import { TransformTree } from './transform-tree.ts';

/** Optical axes (z forward, x right, y down) in a body whose axes are x forward, y left, z up. */
const OPTICAL_IN_BODY: Quaternion = { x: -0.5, y: 0.5, z: -0.5, w: 0.5 };
const NO_TURN: Quaternion = { x: 0, y: 0, z: 0, w: 1 };
const ORIGIN: Pose = { position: { x: 0, y: 0, z: 0 }, orientation: NO_TURN };
/** Assumed pose of a camera whose pose is unknown: 1 m above the ground, looking ahead. */
const UNKNOWN_MOUNT: Pose = { position: { x: 0, y: 0, z: 1 }, orientation: OPTICAL_IN_BODY };
const BASE_FRAMES = ['base_link', 'base_footprint'];

/** A topic and the type of its messages, in ROS 2 notation. */
export interface TypedTopic {
  name: string;
  type: string;
}

/** Collects poses and state, live or from a recording: from tf, odometry and the battery. */
export class WorldState {
  twist: Twist = zeroTwist();
  battery: Battery | null = null;
  readonly #tree = new TransformTree();
  /** Frames that odometry positions, as long as tf does not. */
  readonly #byOdometry = new Set<string>();
  #base: string | null = null;
  #newestNs = 0n;

  /** Selects the topics that contribute to the state. */
  static topicsOf<T extends TypedTopic>(topics: readonly T[]): T[] {
    const types = [...TF_TYPES, ...ODOMETRY_TYPES, ...BATTERY_TYPES];
    return topics.filter(({ type }) => types.includes(type));
  }

  /** Topics whose transforms are valid even before they are published. */
  static staticTopicsOf<T extends TypedTopic>(topics: readonly T[]): T[] {
    return topics.filter(({ name, type }) => TF_TYPES.includes(type) && name.endsWith(STATIC_SUFFIX));
  }

  /** @throws {Error} if the message does not match its type */
  take({ name, type }: TypedTopic, message: unknown): void {
    if (TF_TYPES.includes(type)) this.#takeTransforms(message, name.endsWith(STATIC_SUFFIX));
    else if (ODOMETRY_TYPES.includes(type)) this.#takeOdometry(message);
    else if (BATTERY_TYPES.includes(type)) this.#takeBattery(message);
    else this.#takePose(message);
  }

  /**
   * Pose in the world of the optical axes of a cloud's frame, at the time of its stamp; without a stamp (0), the latest
   * pose.
   */
  opticalPose(frameId: string, stampOrNone: bigint, axes: CloudAxes): Pose {
    const stamp = stampOrNone === 0n ? this.#newestNs : stampOrNone;
    const placed = this.#tree.poseInRoot(frameName(frameId), stamp);
    if (placed !== null) {
      return axes === 'optical'
        ? placed.pose
        : compose(placed.pose, { position: ORIGIN.position, orientation: OPTICAL_IN_BODY });
    }
    const base = this.#base === null ? null : this.#tree.poseInRoot(this.#base, stamp);
    return base === null ? UNKNOWN_MOUNT : compose(base.pose, UNKNOWN_MOUNT);
  }

  /**
   * A frame's pose in the world, at the time of a stamp; without a stamp (0), the latest. The world is the frame in which
   * the robot is known.
   *
   * @returns `null` if it is not known where the frame is, or where the robot is
   */
  framePose(frameId: string, stampOrNone: bigint): Pose | null {
    const frame = frameName(frameId);
    const stamp = stampOrNone === 0n ? this.#newestNs : stampOrNone;
    const base = this.#baseFrame;
    const world = base === null ? null : (this.#tree.poseInRoot(base, stamp)?.root ?? null);
    if (world === null) return null;
    if (frame === world) return ORIGIN;
    const placed = this.#tree.poseInRoot(frame, stamp);
    return placed?.root === world ? placed.pose : null;
  }

  /** Latest pose of base_link in the world. */
  get basePose(): Pose {
    const frame = this.#baseFrame;
    return (frame === null ? null : this.#tree.poseInRoot(frame, this.#newestNs)?.pose) ?? ORIGIN;
  }

  get #baseFrame(): string | null {
    return BASE_FRAMES.find((name) => this.#tree.has(name)) ?? this.#base;
  }

  /** Call after a jump in time. */
  forgetMoving(): void {
    this.#tree.forgetMoving();
    this.#newestNs = 0n;
    this.twist = zeroTwist();
  }

  #takeTransforms(message: unknown, fixed: boolean): void {
    for (const { header, child_frame_id, transform } of tfMessageSchema.parse(message).transforms) {
      const child = frameName(child_frame_id);
      this.#byOdometry.delete(child);
      this.#place(
        header.frame_id,
        child,
        stampNs(header.stamp),
        transform.translation,
        transform.rotation,
        fixed,
      );
    }
  }

  #takeOdometry(message: unknown): void {
    const { header, child_frame_id, pose, twist } = odometrySchema.parse(message);
    const child = frameName(child_frame_id);
    this.#base = child;
    this.twist = twist.twist;
    if (this.#tree.has(child) && !this.#byOdometry.has(child)) return;
    this.#byOdometry.add(child);
    const { position, orientation } = pose.pose;
    this.#place(header.frame_id, child, stampNs(header.stamp), position, orientation, false);
  }

  /** Pose of `base_link`: the message names only the reference frame. */
  #takePose(message: unknown): void {
    const { header, pose } = poseStampedSchema.parse(message);
    const { position, orientation } = 'pose' in pose ? pose.pose : pose;
    const base = BASE_FRAMES[0] as string;
    this.#base = base;
    if (this.#tree.has(base) && !this.#byOdometry.has(base)) return;
    this.#byOdometry.add(base);
    this.#place(header.frame_id, base, stampNs(header.stamp), position, orientation, false);
  }

  #place(
    parent: string,
    child: string,
    stamp: bigint,
    position: Pose['position'],
    rotation: Quaternion,
    fixed: boolean,
  ): void {
    const orientation = unitQuaternion(rotation);
    if (orientation === null || !isFiniteVector(position)) {
      throw new Error(`the transform of ${child} is none`);
    }
    if (!this.#tree.set(frameName(parent), child, stamp, { position, orientation }, fixed)) {
      throw new Error(`too many frames: ${child} is not kept`);
    }
    if (stamp > this.#newestNs) this.#newestNs = stamp;
  }

  #takeBattery(message: unknown): void {
    const { voltage, percentage } = batteryStateSchema.parse(message);
    if (!(voltage >= 0)) return;
    this.battery = { voltage, percentage: percentage >= 0 ? Math.min(percentage, 1) : 0 };
  }
}
