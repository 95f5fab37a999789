/** Turns a vector by a unit quaternion, in GLSL. */
export const ROTATE = /* glsl */ `
vec3 rotate(vec4 q, vec3 v) {
  return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v);
}
`;
