import { type Battery, compose, type Pose, type Quaternion, type Twist, zeroTwist } from '@farpoint/protocol';
import type { CloudAxes } from './point-cloud2.ts';
import type { RecordedMessage, RecordedTopic } from './recording.ts';
import {
  BATTERY_TYPES,
  batteryStateSchema,
  frameName,
  isFiniteVector,
  ODOMETRY_TYPES,
  odometrySchema,
  stampNs,
  TF_TYPES,
  tfMessageSchema,
  unitQuaternion,
} from './ros-messages.ts';
import { TransformTree } from './transform-tree.ts';

/** Optical axes (z forward, x right, y down) in a body whose axes are x forward, y left, z up. */
const OPTICAL_IN_BODY: Quaternion = { x: -0.5, y: 0.5, z: -0.5, w: 0.5 };
const NO_TURN: Quaternion = { x: 0, y: 0, z: 0, w: 1 };
const ORIGIN: Pose = { position: { x: 0, y: 0, z: 0 }, orientation: NO_TURN };
/** Where a camera is taken to be of which nobody says where: 1 m above the ground, looking ahead. */
const UNKNOWN_MOUNT: Pose = { position: { x: 0, y: 0, z: 1 }, orientation: OPTICAL_IN_BODY };
const BASE_FRAMES = ['base_link', 'base_footprint'];
const STATIC_SUFFIX = '/tf_static';

/** What a recording has said so far of where things are: from tf, odometry and the battery. */
export class PlaybackState {
  twist: Twist = zeroTwist();
  battery: Battery | null = null;
  readonly #tree = new TransformTree();
  /** Frames that odometry places, as long as tf does not. */
  readonly #byOdometry = new Set<string>();
  #base: string | null = null;
  #newestNs = 0n;

  /** Of a recording's topics those that are needed. */
  static topicsOf(topics: readonly RecordedTopic[]): RecordedTopic[] {
    const types = [...TF_TYPES, ...ODOMETRY_TYPES, ...BATTERY_TYPES];
    return topics.filter(({ type }) => types.includes(type));
  }

  /** Topics whose transforms hold from before they are said. */
  static staticTopicsOf(topics: readonly RecordedTopic[]): RecordedTopic[] {
    return topics.filter(({ name, type }) => TF_TYPES.includes(type) && name.endsWith(STATIC_SUFFIX));
  }

  /** @throws {Error} where the message is not what its type says */
  take({ topic, data }: Pick<RecordedMessage, 'topic' | 'data'>): void {
    const message = topic.decode(data);
    if (TF_TYPES.includes(topic.type)) this.#takeTransforms(message, topic.name.endsWith(STATIC_SUFFIX));
    else if (ODOMETRY_TYPES.includes(topic.type)) this.#takeOdometry(message);
    else this.#takeBattery(message);
  }

  /** Of a cloud's frame, its optical axes in the world at the time of its stamp. */
  opticalPose(frameId: string, stamp: bigint, axes: CloudAxes): Pose {
    const placed = this.#tree.poseInRoot(frameName(frameId), stamp);
    if (placed !== null) {
      return axes === 'optical'
        ? placed.pose
        : compose(placed.pose, { position: ORIGIN.position, orientation: OPTICAL_IN_BODY });
    }
    const base = this.#base === null ? null : this.#tree.poseInRoot(this.#base, stamp);
    return base === null ? UNKNOWN_MOUNT : compose(base.pose, UNKNOWN_MOUNT);
  }

  /** base_link in the world, as last said. */
  get basePose(): Pose {
    const frame = BASE_FRAMES.find((name) => this.#tree.has(name)) ?? this.#base;
    return (frame == null ? null : this.#tree.poseInRoot(frame, this.#newestNs)?.pose) ?? ORIGIN;
  }

  /** After a jump in time. */
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
