/** What a prediction is made of, and what it says of itself. */
import type { BaseRamps } from './base-model.ts';

/** What the robot says of itself in a telemetry message. */
export interface ReportedMotion {
  /** When the pose was measured: the robot's monotonic clock, ms. */
  robotMs: number;
  /** When the message arrived: the operator's clock, ms. */
  arrivedMs: number;
  /** base_link in the world, m and rad. */
  x: number;
  y: number;
  yaw: number;
  /** Something keeps the robot from following commands: it is stopped, held or latched, or drives by itself. */
  held: boolean;
  /** Share of the commanded velocity that the robot lets through, 0–1. */
  factor: number;
  /** The fastest that it drives straight on now, m/s. */
  mostLinear: number;
}

/** What the robot's welcome says: what no message loosens, and how it ramps. */
export interface PredictionLimits extends BaseRamps {
  maxLinear: number;
  /** Left out: 0, the base cannot go sideways. */
  maxLateral?: number | undefined;
  maxAngular: number;
  watchdogMs: number;
}

/** Why the pose is led on, or why it is as reported. */
export type PredictionState =
  | 'predicted'
  | 'no-pose' // nothing is reported yet
  | 'not-driving' // this operator does not drive the robot
  | 'held' // the robot follows no commands now
  | 'stale'; // nothing has been reported for a while
