/** Messages between the main thread and the thread that publishes velocities. */
import type { Twist } from '@farpoint/protocol';
import type { TopicEntry } from '@farpoint/ros';
import type { GraphOptions } from '../../ground/ros/open-graph.ts';

export interface RosDriveOptions {
  graph: GraphOptions;
  entry: TopicEntry;
  /** After this long without a velocity, zero is published, ms. */
  silenceMs: number;
}

/** What the thread starts with. */
export interface RosDriveSetup extends RosDriveOptions {
  /** The memory of its signs of life (sink-beat.ts). */
  beat: SharedArrayBuffer;
}

export type RosDriveRequest = { type: 'twist'; twist: Twist; hold: boolean } | { type: 'close' };

export type RosDriveReport =
  /** A fault that may be temporary. */
  | { type: 'fault'; detail: string }
  /** The number of nodes that subscribe to the velocity, at each change. */
  | { type: 'listeners'; count: number }
  /** Publishing is impossible. */
  | { type: 'failed'; detail: string };
