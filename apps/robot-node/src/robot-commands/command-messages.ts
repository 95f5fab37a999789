/** Messages between the main thread and the thread that does commands' actions in the robot's ROS graph. */
import type { GraphOptions } from '../ros/open-graph.ts';
import type { ActionResult } from './command-actor.ts';
import type { CallAction, PublishAction } from './command-configuration.ts';

export interface CommandWorkerSetup {
  graph: GraphOptions;
  /** All that are ever published. */
  publishes: readonly PublishAction[];
}

export type CommandWorkerRequest =
  | { type: 'act'; number: number; action: PublishAction | CallAction; timeoutMs: number }
  | { type: 'close' };

export type CommandWorkerReport =
  | { type: 'result'; number: number; result: ActionResult }
  /** A fault that may be temporary. */
  | { type: 'fault'; detail: string };
