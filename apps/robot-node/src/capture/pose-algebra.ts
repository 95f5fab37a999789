import type { Pose, Quaternion, Vector3 } from '@farpoint/protocol';

/** The rotation `a` after `b`. */
export function multiply(a: Quaternion, b: Quaternion): Quaternion {
  return {
    x: a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
    y: a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
    z: a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
    w: a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
  };
}

export function rotate(q: Quaternion, v: Vector3): Vector3 {
  const { x, y, z } = multiply(multiply(q, { ...v, w: 0 }), conjugate(q));
  return { x, y, z };
}

/** The pose of a frame in the world, given its pose in `parent` and the parent's pose in the world. */
export function compose(parent: Pose, child: Pose): Pose {
  const offset = rotate(parent.orientation, child.position);
  return {
    position: {
      x: parent.position.x + offset.x,
      y: parent.position.y + offset.y,
      z: parent.position.z + offset.z,
    },
    orientation: multiply(parent.orientation, child.orientation),
  };
}

/** The world's pose in the frame whose pose in the world is given. */
export function inverse(pose: Pose): Pose {
  const orientation = conjugate(pose.orientation);
  const { x, y, z } = rotate(orientation, pose.position);
  return { position: { x: -x, y: -y, z: -z }, orientation };
}

function conjugate({ x, y, z, w }: Quaternion): Quaternion {
  return { x: -x, y: -y, z: -z, w };
}
