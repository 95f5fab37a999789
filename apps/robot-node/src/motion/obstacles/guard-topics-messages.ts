/** What the guard's topics are, and the messages between the main thread and the thread that hears them. */

import type { Twist } from '@farpoint/protocol';
import { ENCAPSULATION_BYTES } from '@farpoint/ros';
import type { FloorPose } from '@farpoint/safety';
import type { GraphOptions } from '../../ground/ros/open-graph.ts';
import type { ScanGuardOptions } from '../../sense/obstacles/scan-guard.ts';
import type { FrameTopics } from '../../sense/obstacles/sensor-frames.ts';
import type { SensorMount } from '../../sense/sources/sensor-mount.ts';
import { saysStop } from '../stops/bool-message.ts';

/** A laser scanner's topic, and where the scanner's frame sits in base_link. */
export interface GuardScan {
  topic: string;
  mount: SensorMount;
}

/** A topic by which another program demands that the robot be slower, or stop. */
export interface CollisionTopic {
  topic: string;
  type: CollisionType;
  /** A topic that is silent for longer, ms, allows no more than this, m/s. */
  silentMs: number;
  silentMps: number;
}

/** The topics of the robot's ROS graph that the guard hears. */
export interface GuardTopicsOptions {
  graph: GraphOptions;
  scans: readonly GuardScan[];
  collision: CollisionTopic | null;
  /** What says where the scanners sit, besides the configuration. */
  frames?: FrameTopics | undefined;
}

/** What the thread starts with. */
export interface GuardTopicsSetup {
  graph: GraphOptions;
  scans: readonly { topic: string; guard: ScanGuardOptions }[];
  collision: { topic: string; type: CollisionType; cells: SharedArrayBuffer } | null;
  frames: FrameTopics | null;
  /** The memory of its signs of life. */
  beat: SharedArrayBuffer;
}

export type GuardTopicsRequest =
  /** Odometry came. */
  { type: 'pose'; pose: FloorPose; twist: Readonly<Twist> | null; atMs: number } | { type: 'close' };

export type GuardTopicsReport =
  /** The collision topic demands something else than before: look at once. */
  | { type: 'changed' }
  /** A fault that may be temporary: of the graph, or of a message. */
  | { type: 'fault'; detail: string }
  /** The topics cannot be heard. */
  | { type: 'failed'; detail: string };

/** `bool`: std_msgs/Bool, true stops. `speed`: std_msgs/Float32, the highest speed in m/s. */
export const COLLISION_TYPES = { bool: 'std_msgs/msg/Bool', speed: 'std_msgs/msg/Float32' } as const;
export type CollisionType = keyof typeof COLLISION_TYPES;

/** Of a std_msgs/Float32. */
const FLOAT_BYTES = 4;

/**
 * The highest speed that a serialised message allows, m/s; infinity for any. What is malformed, no number or negative
 * stops.
 */
export function demandedMps(type: CollisionType, version: 1 | 2, bytes: Uint8Array): number {
  if (type === 'bool') return saysStop(version, bytes) ? 0 : Number.POSITIVE_INFINITY;
  const begin = version === 1 ? 0 : ENCAPSULATION_BYTES;
  if (bytes.length !== begin + FLOAT_BYTES) return 0;
  const isLittle = version === 1 || ((bytes[1] as number) & 1) === 1;
  const most = new DataView(bytes.buffer, bytes.byteOffset, bytes.length).getFloat32(begin, isLittle);
  return Number.isNaN(most) ? 0 : Math.max(0, most);
}
