/** Messages between the main thread and the thread that speaks with a navigator in the robot's ROS graph. */
import type { Twist } from '@farpoint/protocol';
import type { RosNavigatorOptions } from './goal-configuration.ts';
import type { FloorPlace } from './navigator.ts';

export type GoalWorkerSetup = RosNavigatorOptions;

export type GoalWorkerRequest = { type: 'goal'; goal: FloorPlace } | { type: 'close' };

export type GoalWorkerReport =
  /** `twist` is `null` for a message that is no velocity. */
  | { type: 'velocity'; twist: Twist | null; receivedMs: number }
  /** A fault that may be temporary. */
  | { type: 'fault'; detail: string };
