/** Cameras whose pictures come from a program's own code, and not from a GStreamer element. */
import type { TopicEntry } from '@farpoint/ros';
import type { CameraOptions, Thing } from '@farpoint/sim';
import type { GraphOptions } from '../../../ground/ros/open-graph.ts';

/** A topic of a ROS graph. */
export interface RosVideoSource {
  kind: 'ros';
  graph: GraphOptions;
  entry: TopicEntry;
}

/** A camera of the simulated robot. */
export interface SimVideoSource {
  kind: 'sim';
  camera: CameraOptions;
  framesPerS: number;
  seed: number;
  /** The base's thread writes the world here. If undefined, the robot stays at its start and nothing moves. */
  snapshot?: SharedArrayBuffer | undefined;
  /** Put into the world. */
  things?: readonly Thing[] | undefined;
}

/** Plain data, so that it can be passed to the thread that feeds the cameras. */
export type FeedSource = RosVideoSource | SimVideoSource;

export function isFeedSource(source: { kind: string }): source is FeedSource {
  return source.kind === 'ros' || source.kind === 'sim';
}
