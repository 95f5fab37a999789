import type { Batch } from '@farpoint/operator';
import type { Vector4 } from 'three';

/**
 * Writes where the camera was at a packet's capture into uniforms.
 *
 * @param position gets x, y, z in metres, and `w`
 * @param orientation gets a unit quaternion
 */
export function writePose(
  batch: Batch,
  packet: number,
  position: Vector4,
  w: number,
  orientation: Vector4,
): void {
  const component = (index: number) => batch.poseComponent(packet, index);
  position.set(component(0), component(1), component(2), w);
  orientation.set(component(3), component(4), component(5), component(6));
}

/** Turns a vector by a unit quaternion, in GLSL. */
export const ROTATE = /* glsl */ `
vec3 rotate(vec4 q, vec3 v) {
  return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v);
}
`;
