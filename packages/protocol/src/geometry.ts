import * as z from 'zod/mini';

// Named and structured as ROS geometry_msgs; SI units; axes as in REP-103 (body and world: x forward, y left, z up;
// camera optical frame: z forward, x right, y down).

export const vector3Schema = z.strictObject({ x: z.number(), y: z.number(), z: z.number() });
/** Three components, geometry_msgs/Vector3. What uses it says the unit. */
export interface Vector3 {
  /** Along the first axis: forward in the world and in a body, to the right in an optical frame. */
  x: number;
  /** Along the second axis: to the left in the world and in a body, down in an optical frame. */
  y: number;
  /** Along the third axis: up in the world and in a body, forward in an optical frame. */
  z: number;
}

/** Accepts quaternions within 1 % of unit length; any other does not describe an orientation. */
export const quaternionSchema = z
  .strictObject({ x: z.number(), y: z.number(), z: z.number(), w: z.number() })
  .check(z.refine((q) => Math.abs(Math.hypot(q.x, q.y, q.z, q.w) - 1) < 0.01, 'not a unit quaternion'));
/** Unit quaternion, geometry_msgs/Quaternion. */
export interface Quaternion {
  /** First component of the vector part. */
  x: number;
  /** Second component of the vector part. */
  y: number;
  /** Third component of the vector part. */
  z: number;
  /** Scalar part. */
  w: number;
}

/** Position in metres and orientation, geometry_msgs/Pose. */
export const poseSchema = z.strictObject({ position: vector3Schema, orientation: quaternionSchema });
/** Position and orientation of a frame in the world, geometry_msgs/Pose. */
export interface Pose {
  /** Metres. */
  position: Vector3;
  /** From the frame's axes to the world's. */
  orientation: Quaternion;
}

/** Linear velocity in m/s and angular velocity in rad/s, geometry_msgs/Twist. */
export const twistSchema = z.strictObject({ linear: vector3Schema, angular: vector3Schema });
/** Velocity, geometry_msgs/Twist. */
export interface Twist {
  /** m/s. */
  linear: Vector3;
  /** rad/s, about each axis. */
  angular: Vector3;
}

export function zeroTwist(): Twist {
  return { linear: { x: 0, y: 0, z: 0 }, angular: { x: 0, y: 0, z: 0 } };
}

/** Whether no component requests motion. */
export function isZeroTwist(twist: Twist): boolean {
  const { linear, angular } = twist;
  return [linear.x, linear.y, linear.z, angular.x, angular.y, angular.z].every((c) => c === 0);
}

/** Pinhole model of a camera; pixel centres are at integer coordinates. */
export interface CameraIntrinsics {
  width: number;
  height: number;
  /** Focal lengths and principal point, pixels. */
  fx: number;
  fy: number;
  cx: number;
  cy: number;
}
