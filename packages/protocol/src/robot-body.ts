/**
 * Deeper inside the footprint are parts of the robot itself, metres: a cell of the obstacle guard's map, within which
 * nobody can tell.
 */
export const OWN_BODY_M = 0.05;

/** What a robot takes of the floor, and how it stops. */
export interface RobotBody {
  /** Corners of the outline around base_link, counter-clockwise, metres: x forward, y to the left. */
  footprint: readonly {
    /** Metres ahead of base_link. */
    x: number;
    /** Metres to the left of base_link. */
    y: number;
  }[];
  /** How hard the robot brakes in ordinary driving, m/s². */
  decelerationMps2: number;
  /** How fast the robot gains speed, m/s². Left out where it is not known. */
  accelerationMps2?: number | undefined;
  /** How fast the robot begins and ends a turn, rad/s². Left out where it is not known. */
  turnRadps2?: number | undefined;
  /** Which heights matter to the robot. Left out where it does not say. */
  heights?: BodyHeights | undefined;
}

/** Heights above the x-y plane of base_link at which the robot hits what is there, or falls, metres. */
export interface BodyHeights {
  /** What is lower is floor. */
  clearanceM: number;
  /** What is higher is passed under. */
  heightM: number;
  /** What lies lower than this below the plane is a missing floor. */
  dropM: number;
  /** By how much `clearanceM` and `dropM` grow with each metre of distance: the sensors' tilt is not exactly known. */
  slope: number;
}
