/**
 * Tints what the robot would hit and where its floor is missing, over whatever colours a cloud has. Compiled in only while
 * something is tinted (shader-features.ts).
 */
import type { Rgb } from './colour-map.ts';
import { DROP_TINT, HIT_TINT, LAST_TINTED_M, TINT_SHARE, TINTED_M } from './hazards.ts';

/**
 * Between no tint and the whole of it, metres: an edge that noise moves does not flicker. Chosen by eye:
 * about the noise of a depth camera at 1.5 m.
 */
const EDGE_M = 0.005;

const glslOf = (tint: Rgb) => `vec3(${tint.map((part) => part.toFixed(3)).join(', ')})`;

/** Set by `setHazards`. */
export const HAZARD_UNIFORMS = /* glsl */ `
// Position of base_link in the world; w: what is nearer is the robot itself, metres.
uniform vec4 hazardBase;
// The z axis of base_link in the world.
uniform vec3 hazardUp;
// Clearance, height, drop (metres) and slope.
uniform vec4 hazardBand;
`;

export const HAZARD_FUNCTION = /* glsl */ `
vec3 hazardTinted(vec3 rgb, vec3 world) {
#ifdef HAZARDS
  vec3 fromBase = world - hazardBase.xyz;
  float away = length(fromBase.xy);
  if (away < hazardBase.w || away > ${LAST_TINTED_M.toFixed(1)}) return rgb;
  float height = dot(fromBase, hazardUp);
  // The robot's own guard measures distances along its grid.
  float tolerance = hazardBand.w * max(abs(fromBase.x), abs(fromBase.y));
  float share = ${TINT_SHARE.toFixed(2)} * (1.0 - smoothstep(${TINTED_M.toFixed(1)}, ${LAST_TINTED_M.toFixed(1)}, away));
  float low = hazardBand.x + tolerance;
  float hit = smoothstep(low - ${EDGE_M}, low + ${EDGE_M}, height)
    * (1.0 - smoothstep(hazardBand.y - ${EDGE_M}, hazardBand.y + ${EDGE_M}, height));
  float deep = -hazardBand.z - tolerance;
  float drop = 1.0 - smoothstep(deep - ${EDGE_M}, deep + ${EDGE_M}, height);
  return mix(mix(rgb, ${glslOf(HIT_TINT)}, share * hit), ${glslOf(DROP_TINT)}, share * drop);
#else
  return rgb;
#endif
}
`;
