/**
 * The one place where axes are converted. REP-103 world: x forward, y left, z up. three.js: x right, y up, z back, so
 * that x₃ = −y, y₃ = z, z₃ = −x.
 */
import { Group, Matrix4, type Quaternion, Vector3 } from 'three';

/** Converts world coordinates to three's; the matrix of the root group of everything in the robot's world. */
export function worldToThree(): Matrix4 {
  return new Matrix4().makeBasis(new Vector3(0, 0, -1), new Vector3(-1, 0, 0), new Vector3(0, 1, 0));
}

/**
 * Heading of an optical frame (z forward) in the world: angle about z, counter-clockwise from x, radians; `fallback`
 * if it looks straight up or down.
 *
 * @param q unit quaternion
 * @param fallback radians
 */
export function opticalYaw(q: Pick<Quaternion, 'x' | 'y' | 'z' | 'w'>, fallback: number): number {
  // The frame's z axis in the world.
  const x = 2 * (q.x * q.z + q.w * q.y);
  const y = 2 * (q.y * q.z - q.w * q.x);
  return Math.hypot(x, y) < 1e-3 ? fallback : Math.atan2(y, x);
}

/** The robot's world in a three.js scene. Children are placed in metres, by REP-103 (x forward, y left, z up). */
export class RobotWorld extends Group {
  /** Creates an empty group. Its matrix converts the robot's axes to three's, and three does not update it. */
  constructor() {
    super();
    this.matrixAutoUpdate = false;
    this.matrix.copy(worldToThree());
  }
}
