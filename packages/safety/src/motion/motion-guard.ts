import type { Intervention, Twist } from '@farpoint/protocol';

/** What a guard lets through of a requested velocity. The robot keeps to the arc on which it was told to go. */
export interface MotionBound {
  /** Share of the requested velocity, linear and angular alike, 0 to 1. */
  factor: number;
  /** Why it is less than 1; `null` if and only if it is 1. */
  reason: Intervention | null;
  /** Whether the robot must brake as hard as it can. */
  urgent: boolean;
}

/** Everything goes. */
export const FREE: Readonly<MotionBound> = Object.freeze({ factor: 1, reason: null, urgent: false });

/** Bounds the robot's motion by one kind of knowledge. Pure: what it knows and the time are given to it. */
export interface MotionGuard {
  /**
   * @param wish the requested velocity of base_link: linear.x and linear.y in m/s, angular.z in rad/s
   * @param nowMs the robot's monotonic clock, ms
   */
  bound(wish: Readonly<Twist>, nowMs: number): Readonly<MotionBound>;
}
