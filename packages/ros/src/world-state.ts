import {
  type Battery,
  compose,
  inverse,
  OPTICAL_IN_BODY,
  type Pose,
  type Quaternion,
  type Twist,
} from '@farpoint/protocol';
import { BatteryGauge } from './battery-gauge.ts';
import {
  BATTERY_TYPES,
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
import { isLocalised, TransformTree } from './transform-tree.ts';

const NO_TURN: Quaternion = { x: 0, y: 0, z: 0, w: 1 };
const ORIGIN: Pose = { position: { x: 0, y: 0, z: 0 }, orientation: NO_TURN };
/** Assumed pose of a camera of which nobody says where it sits: 1 m above the ground, looking ahead. For the picture only. */
const UNKNOWN_MOUNT: Pose = { position: { x: 0, y: 0, z: 1 }, orientation: OPTICAL_IN_BODY };
const OPTICAL: Pose = { position: ORIGIN.position, orientation: OPTICAL_IN_BODY };
/** Of a robot whose base's frame nobody names, in the order in which they are looked for. */
export const BASE_FRAMES: readonly string[] = ['base_link', 'base_footprint'];
/** What odometry means whose frames are not named. */
const ODOM_FRAME = 'odom';
/** What moves is not known where its newest sample is older, or its oldest younger, ms. */
const MOST_OFF_MS = 300;

/** A topic and the type of its messages, in ROS 2 notation. */
export interface TypedTopic {
  name: string;
  type: string;
}

/** The times of stamps. */
export interface StampTimes {
  /**
   * @param source a topic, or a transform: stamps of one source come in their order
   * @param mayBeAhead whether stamps may lie ahead of time, as those of localisation do
   * @returns of the clock that poses are asked for, ms; why the stamp is refused
   */
  of(source: string, stampNs: bigint, mayBeAhead: boolean): number | string;
}

/** Times of recordings, where all stamps are believed: ms since 1970. */
const BY_STAMP: StampTimes = { of: (_, ns) => timeOfStamp(ns) ?? 0 };

/** ms since 1970; `null` without a stamp (0). */
function timeOfStamp(ns: bigint): number | null {
  return ns === 0n ? null : Number(ns) / 1e6;
}

/** Where the robot is, and how it moves: all of one time. */
export interface BaseMotion {
  /** Of the base's frame in the world. */
  pose: Pose;
  /** In the base's frame; `null` if nobody has said it lately. */
  twist: Twist | null;
  /** Of the stamps' clock, ms; `null` if nobody says where the robot is. */
  timeMs: number | null;
}

/** Where a sensor was when it took something. */
export interface PlacedSensor {
  /** Of its optical axes in the world, as well as it is known: what pictures need. */
  cameraPose: Pose;
  /** Of the base's frame in the world; `null` if it was not known then. */
  base: Pose | null;
  /** Of its optical axes in the base's frame, as tf says; `null` if tf does not. */
  mount: Pose | null;
}

/** Collects poses and state, live or from a recording: from tf, odometry and the battery. */
export class WorldState {
  battery: Battery | null = null;
  readonly #gauge = new BatteryGauge();
  readonly #times: StampTimes;
  readonly #tree = new TransformTree();
  /** Frames that odometry positions, as long as tf does not. */
  readonly #byOdometry = new Set<string>();
  readonly #configured: string | null;
  /** The frame that odometry positions. */
  #told: string | null = null;
  #newestMs = Number.NEGATIVE_INFINITY;
  #twist: { twist: Twist; timeMs: number } | null = null;

  /** @param base the frame of the robot's base; `null`: as odometry and tf name it */
  constructor(times: StampTimes = BY_STAMP, base: string | null = null) {
    this.#times = times;
    this.#configured = base === null ? null : frameName(base);
  }

  /** Selects the topics that contribute to the state. */
  static topicsOf<T extends TypedTopic>(topics: readonly T[]): T[] {
    const types = [...TF_TYPES, ...ODOMETRY_TYPES, ...BATTERY_TYPES];
    return topics.filter(({ type }) => types.includes(type));
  }

  /** Topics whose transforms are valid even before they are published. */
  static staticTopicsOf<T extends TypedTopic>(topics: readonly T[]): T[] {
    return topics.filter(({ name, type }) => TF_TYPES.includes(type) && name.endsWith(STATIC_SUFFIX));
  }

  /**
   * Takes a message, or what of it can be taken.
   *
   * @returns what people should know: why something of it was left out, for example; `null` if there is nothing
   * @throws {Error} if the message does not match its type
   */
  take({ name, type }: TypedTopic, message: unknown): string | null {
    if (TF_TYPES.includes(type)) return this.#takeTransforms(message, name.endsWith(STATIC_SUFFIX));
    if (ODOMETRY_TYPES.includes(type)) return this.#takeOdometry(name, message);
    if (!BATTERY_TYPES.includes(type)) return this.#takePose(name, message);
    this.battery = this.#gauge.battery(message);
    return this.#gauge.warning;
  }

  /** The same as {@link place} by the stamp of a recording, where all stamps are believed. */
  placeByStamp(frameId: string, ns: bigint, axes: CloudAxes): PlacedSensor {
    return this.place(frameId, timeOfStamp(ns), axes);
  }

  /**
   * Where a cloud's sensor was.
   *
   * @param timeMs when the cloud was taken; `null` if nobody says: the newest poses count
   * @param configured its mount, where tf does not say it
   */
  place(
    frameId: string,
    timeMs: number | null,
    axes: CloudAxes,
    configured: Pose | null = null,
  ): PlacedSensor {
    const atMs = timeMs ?? this.#newestMs;
    const frame = this.#baseFrame;
    const base = frame === null ? null : this.#tree.poseInRoot(frame, atMs);
    const sensor = this.#tree.poseInRoot(frameName(frameId), atMs);
    const optical = sensor === null ? null : axes === 'optical' ? sensor.pose : compose(sensor.pose, OPTICAL);
    const known = base !== null && base.offMs <= MOST_OFF_MS ? base.pose : null;
    if (base !== null && optical !== null && sensor?.root === base.root)
      return { cameraPose: optical, base: known, mount: compose(inverse(base.pose), optical) };
    const onBase =
      sensor !== null && (frame === null ? BASE_FRAMES.includes(sensor.root) : sensor.root === frame);
    const mount = onBase ? optical : null;
    // Of a robot that nobody places, a sensor that somebody does is where it is.
    if (base === null && optical !== null) return { cameraPose: optical, base: null, mount };
    return {
      cameraPose: compose(base?.pose ?? ORIGIN, mount ?? configured ?? UNKNOWN_MOUNT),
      base: known,
      mount,
    };
  }

  /**
   * A frame's pose in the world, at the time of a stamp; without a stamp (0), the latest. The world is the frame in which
   * the robot is known.
   *
   * @returns `null` if it is not known where the frame is, or where the robot is
   */
  framePose(frameId: string, stampOrNone: bigint): Pose | null {
    const frame = frameName(frameId);
    const judged = stampOrNone === 0n ? this.#newestMs : this.#times.of('', stampOrNone, true);
    const timeMs = typeof judged === 'number' ? judged : this.#newestMs;
    const base = this.#baseFrame;
    const world = base === null ? null : (this.#tree.poseInRoot(base, timeMs)?.root ?? null);
    if (world === null) return null;
    if (frame === world) return ORIGIN;
    const placed = this.#tree.poseInRoot(frame, timeMs);
    return placed?.root === world ? placed.pose : null;
  }

  /** The robot's newest: pose, velocity and time belong together. */
  get base(): BaseMotion {
    const frame = this.#baseFrame;
    const timeMs = frame === null ? null : this.#tree.newestMs(frame);
    const placed = frame === null ? null : this.#tree.poseInRoot(frame, timeMs ?? this.#newestMs);
    const told = this.#twist;
    const isOfThen = told !== null && timeMs !== null && Math.abs(told.timeMs - timeMs) <= MOST_OFF_MS;
    return { pose: placed?.pose ?? ORIGIN, twist: isOfThen ? told.twist : null, timeMs };
  }

  /** Call after a jump in time. */
  forgetMoving(): void {
    this.#tree.forgetMoving();
    this.#newestMs = Number.NEGATIVE_INFINITY;
    this.#twist = null;
  }

  /** Another robot's base may have the usual name: only in the tree of what odometry positions it is this one's. */
  get #baseFrame(): string | null {
    if (this.#configured !== null) return this.#configured;
    const root = this.#told === null ? null : this.#rootOf(this.#told);
    const usual = BASE_FRAMES.find(
      (name) => this.#tree.has(name) && (root === null || this.#rootOf(name) === root),
    );
    return usual ?? this.#told;
  }

  #rootOf(frame: string): string | null {
    return this.#tree.poseInRoot(frame, this.#newestMs)?.root ?? null;
  }

  /** What is meant where a message does not name the base's frame. */
  get #unnamed(): string {
    return this.#configured ?? (BASE_FRAMES[0] as string);
  }

  #takeTransforms(message: unknown, fixed: boolean): string | null {
    let fault: string | null = null;
    for (const { header, child_frame_id, transform } of tfMessageSchema.parse(message).transforms) {
      const child = frameName(child_frame_id);
      const { translation: position, rotation } = transform;
      const timeMs = fixed ? 0 : this.#times.of(`tf ${child}`, stampNs(header.stamp), isLocalised(child));
      if (typeof timeMs === 'string') {
        fault ??= `the transform of ${child}: ${timeMs}`;
        continue;
      }
      const anew = this.#byOdometry.has(child);
      const why = this.#place(header.frame_id, child, timeMs, position, rotation, fixed, anew);
      // What is left out takes nothing over.
      if (why === null) this.#byOdometry.delete(child);
      fault ??= why;
    }
    return fault;
  }

  #takeOdometry(topic: string, message: unknown): string | null {
    const { header, child_frame_id, pose, twist } = odometrySchema.parse(message);
    const child = frameName(child_frame_id) || this.#unnamed;
    const parent = frameName(header.frame_id) || ODOM_FRAME;
    if (child === parent)
      return `its child_frame_id is its frame_id, ${child}: it says nothing about the robot`;
    const timeMs = this.#times.of(topic, stampNs(header.stamp), false);
    if (typeof timeMs === 'string') return timeMs;
    this.#told = child;
    const { linear, angular } = twist.twist;
    const isMeasured = isFiniteVector(linear) && isFiniteVector(angular);
    this.#twist = isMeasured ? { twist: twist.twist, timeMs } : null;
    if (this.#tree.has(child) && !this.#byOdometry.has(child)) return null;
    this.#byOdometry.add(child);
    return this.#place(parent, child, timeMs, pose.pose.position, pose.pose.orientation, false);
  }

  /** Pose of the base: the message names only the reference frame. */
  #takePose(topic: string, message: unknown): string | null {
    const { header, pose } = poseStampedSchema.parse(message);
    const { position, orientation } = 'pose' in pose ? pose.pose : pose;
    const base = this.#unnamed;
    const parent = frameName(header.frame_id) || ODOM_FRAME;
    if (parent === base) return `its frame_id is ${base}: it says nothing about the robot`;
    const timeMs = this.#times.of(topic, stampNs(header.stamp), false);
    if (typeof timeMs === 'string') return timeMs;
    this.#told = base;
    if (this.#tree.has(base) && !this.#byOdometry.has(base)) return null;
    this.#byOdometry.add(base);
    return this.#place(parent, base, timeMs, position, orientation, false);
  }

  #place(
    parent: string,
    child: string,
    timeMs: number,
    position: Pose['position'],
    rotation: Quaternion,
    fixed: boolean,
    anew = false,
  ): string | null {
    const orientation = unitQuaternion(rotation);
    if (orientation === null || !isFiniteVector(position)) return `the transform of ${child} is none`;
    const verdict = this.#tree.set(frameName(parent), child, timeMs, { position, orientation }, fixed, anew);
    if (verdict === 'too-many') return `too many frames: ${child} is not kept`;
    if (verdict === 'loop') return `${child} cannot be above itself: its transform is not kept`;
    if (!fixed) this.#newestMs = Math.max(this.#newestMs, timeMs);
    return null;
  }
}
