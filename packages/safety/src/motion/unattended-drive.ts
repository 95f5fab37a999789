import type { Twist } from '@farpoint/protocol';

/** What the drive guard knows when it is asked who moves the robot. */
export interface UnattendedFacts {
  /** Whether a driver's command moves the robot now. */
  driven: boolean;
  /** Whether anybody holds the lease. */
  leased: boolean;
  /** Whether the emergency stop is latched. */
  latched: boolean;
  /** Whether something takes the velocities. */
  wheels: boolean;
}

/** Moves the robot while nobody drives. Pure: what it knows and the time are given to it. */
export interface UnattendedDrive {
  /**
   * @param nowMs the robot's monotonic clock, ms; never less than before
   * @returns the velocity that it asks for; `null` while it does not move the robot. It is not applied while the facts say
   * that anything is in the way of motion
   */
  wishAt(nowMs: number, facts: Readonly<UnattendedFacts>): Twist | null;
}
