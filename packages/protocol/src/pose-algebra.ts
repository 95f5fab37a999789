/**
 * Rotations and poses, for every peer that places something in the world. The functions allocate, so do not use them
 * for each point.
 */
import type { Pose, Quaternion, Vector3 } from './geometry.ts';

/**
 * Optical axes (z forward, x right, y down) in a body whose axes are x forward, y left, z up (REP-103): a quarter turn
 * each.
 */
export const OPTICAL_IN_BODY: Readonly<Quaternion> = { x: -0.5, y: 0.5, z: -0.5, w: 0.5 };

/** The rotation that applies `b` first, then `a`. */
export function multiply(a: Quaternion, b: Quaternion): Quaternion {
  return {
    x: a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
    y: a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
    z: a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
    w: a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
  };
}

/** Row-major rotation matrix of a unit quaternion. */
export function rotationMatrix({
  x,
  y,
  z,
  w,
}: Quaternion): [number, number, number, number, number, number, number, number, number] {
  return [
    1 - 2 * (y * y + z * z),
    2 * (x * y - z * w),
    2 * (x * z + y * w),
    2 * (x * y + z * w),
    1 - 2 * (x * x + z * z),
    2 * (y * z - x * w),
    2 * (x * z - y * w),
    2 * (y * z + x * w),
    1 - 2 * (x * x + y * y),
  ];
}

export function rotate(q: Quaternion, v: Vector3): Vector3 {
  const m = rotationMatrix(q);
  return {
    x: m[0] * v.x + m[1] * v.y + m[2] * v.z,
    y: m[3] * v.x + m[4] * v.y + m[5] * v.z,
    z: m[6] * v.x + m[7] * v.y + m[8] * v.z,
  };
}

/**
 * Heading of a body frame (x forward) in the world: angle about z, counter-clockwise from x, radians.
 *
 * @param q unit quaternion
 */
export function bodyYaw({ x, y, z, w }: Quaternion): number {
  return Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
}

/** The child's pose in the parent's parent: `parent`, then `child`, as in tf. */
export function compose(parent: Pose, child: Pose): Pose {
  const moved = rotate(parent.orientation, child.position);
  return {
    position: {
      x: parent.position.x + moved.x,
      y: parent.position.y + moved.y,
      z: parent.position.z + moved.z,
    },
    orientation: multiply(parent.orientation, child.orientation),
  };
}

/** The world's pose in the frame with the given pose in the world. */
export function inverse(pose: Pose): Pose {
  const { x, y, z, w } = pose.orientation;
  const orientation = { x: -x, y: -y, z: -z, w };
  const back = rotate(orientation, pose.position);
  return { position: { x: -back.x, y: -back.y, z: -back.z }, orientation };
}

/** The same direction as a turn of at most half a circle. @param angle radians, such as a difference of two headings */
export function shortestTurn(angle: number): number {
  return angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
}
