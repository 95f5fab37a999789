import type { Battery, Pose, Twist } from '@farpoint/protocol';

/** What a base knows of itself. */
export interface BaseState {
  /** base_link in the world. */
  pose: Pose;
  /** Actual velocity, in base_link. */
  twist: Twist;
  battery: Battery | null;
  /** Touching an obstacle. */
  contact: boolean;
}

/** When it was so, on the robot's clock. */
export interface TimedBaseState extends BaseState {
  timeMs: number;
}

/** Wheels that only a simulation has: time and a wanted velocity in, a place out. */
export interface Base {
  /** Lets time pass until `nowMs`, the robot's clock; the velocity wanted in the meantime is `twist`. */
  advance(nowMs: number, twist: Twist): void;
  readonly state: BaseState;
}
