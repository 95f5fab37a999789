import type { Battery, Pose, Twist } from '@farpoint/protocol';

/** What a base reports about itself. */
export interface BaseState {
  /** Pose of base_link in the world. */
  pose: Pose;
  /** Actual velocity, in base_link; `null` if nobody measures it. */
  twist: Twist | null;
  battery: Battery | null;
  /** Whether the base touches an obstacle. */
  contact: boolean;
  /**
   * When pose and twist were measured, robot's clock, ms; `null` if nobody says where the robot is; if absent, nothing moves
   * it, or it is simulated: now.
   */
  measuredMs?: number | null;
}

/** The time of the state, on the robot's clock. */
export interface TimedBaseState extends BaseState {
  timeMs: number;
}

/** The wheels of a simulated robot: takes time and a requested velocity, gives a pose. */
export interface Base {
  /** Advances to `nowMs` (robot's clock) at the velocity `twist`. */
  advance(nowMs: number, twist: Twist): void;
  readonly state: BaseState;
}
