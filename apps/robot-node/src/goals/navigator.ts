import type { Twist } from '@farpoint/protocol';
import type { Goal } from '@farpoint/safety';

/** A pose on the floor, m and rad. */
export interface FloorPlace {
  x: number;
  y: number;
  yaw: number;
}

/** What leads the robot to a goal. Its velocities are wishes like an operator's: the motion supervisor bounds them. */
export interface Navigator {
  /** Called for each velocity. @param atMs when it came, robot's clock */
  onVelocity: ((twist: Twist, atMs: number) => void) | null;
  /** Leads to this goal from now on. @param pose of the robot */
  begin(goal: Readonly<Goal>, pose: Readonly<FloorPlace>): void;
  /** There is no goal any more. Whatever it says from now on moves nothing. @param pose of the robot; `null` if unknown */
  end(pose: Readonly<FloorPlace> | null): void;
  /** Called every 25 ms while there is a goal. */
  update(goal: Readonly<Goal>, pose: Readonly<FloorPlace>, nowMs: number): void;
  close(): Promise<void>;
}
