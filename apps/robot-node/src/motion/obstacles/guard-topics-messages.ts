/** What the guard's topics are, and the messages between the main thread and the thread that hears them. */
import type { Twist } from '@farpoint/protocol';
import type { FloorPose } from '@farpoint/safety';
import type { GraphOptions } from '../../ground/ros/open-graph.ts';
import type { ScanGuardOptions } from '../../sense/obstacles/scan-guard.ts';
import type { FrameTopics } from '../../sense/obstacles/sensor-frames.ts';
import type { SensorMount } from '../../sense/sources/sensor-mount.ts';
import type { CollisionType } from './collision-message.ts';

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
