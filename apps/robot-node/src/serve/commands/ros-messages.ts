/** Messages between the main thread and the thread that does commands' actions in the robot's ROS graph. */
import type { GraphOptions } from '../../ground/ros/open-graph.ts';
import type { ActionResult } from './command-actor.ts';
import type { GraphAction } from './command-configuration.ts';

export interface RosWorkerSetup {
  graph: GraphOptions;
  /** All that are ever done. */
  actions: readonly GraphAction[];
}

export type RosWorkerRequest =
  | { type: 'begin'; number: number; action: GraphAction; timeoutMs: number }
  | { type: 'cancel'; number: number }
  | { type: 'close' };

export type RosWorkerReport =
  | { type: 'progress'; number: number; detail: string }
  | { type: 'end'; number: number; result: ActionResult }
  /** A fault that may be temporary. */
  | { type: 'fault'; detail: string };
