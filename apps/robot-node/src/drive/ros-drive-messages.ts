/** What the main thread and the thread that publishes velocities say to each other. */
import type { Twist } from '@farpoint/protocol';
import type { TopicEntry } from '@farpoint/ros';
import type { GraphOptions } from '../ros/open-graph.ts';

export interface RosDriveOptions {
  graph: GraphOptions;
  entry: TopicEntry;
  /** Without a word for so long the velocity is zero, ms. */
  silenceMs: number;
}

export type RosDriveRequest = { type: 'twist'; twist: Twist; hold: boolean } | { type: 'close' };

export type RosDriveReport =
  /** Something is wrong that may pass. */
  | { type: 'fault'; detail: string }
  /** How many nodes listen to the velocity, at each change. */
  | { type: 'listeners'; count: number }
  /** It cannot be published at all. */
  | { type: 'failed'; detail: string };
