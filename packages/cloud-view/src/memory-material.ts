/**
 * The shader of remembered surfaces: points as large as a voxel, dimmer and greyer the longer ago they were seen. Each
 * instance is a page of surfels; it fetches them as they were handed on.
 *
 * What is remembered lies on the same surfaces as what is live. It is moved away from the eye by more than the noise of
 * both, so that the live cloud hides it wherever there is one.
 */
import { MEMORY_LAYOUT } from '@farpoint/operator';
import { type ExternalTexture, GLSL3, RawShaderMaterial, Vector2 } from 'three';
import { HAZARD_FUNCTION, HAZARD_UNIFORMS } from './hazard-shader.ts';
import { type HazardUniforms, hazardUniforms } from './hazards.ts';
import { HEIGHT_CUT_FUNCTION, UNLIMITED_M } from './shader-features.ts';

/** Pages in a row of the texture: 2048 texels, which every WebGL 2 has room for. */
export const PAGES_PER_ROW = 8;
/** What was seen this long ago, s, is drawn as old as anything. Chosen by eye. */
export const MEMORY_OLD_S = 300;
/**
 * Brightness of what was just seen, and what of it is left after {@link MEMORY_OLD_S}: nobody may take it for live.
 * Both and the share below are chosen by eye (docs/memory.md has a picture).
 */
const BRIGHTNESS = 0.6;
const OLD_BRIGHTNESS = 0.4;
/** Share of its colour that it loses. */
const GREYED = 0.4;
/**
 * How far it is moved away from the eye, metres and share of the distance: a voxel (memory-layout.ts), and a
 * stereo camera's noise (docs/memory.md).
 */
const BEHIND_M = 0.05;
const BEHIND_SHARE = 0.02;

const { pageSurfels, chunkM, chunkSteps, ageUnitS, voxelM } = MEMORY_LAYOUT;

const vertexShader = /* glsl */ `
precision highp float;
precision highp int;
uniform highp usampler2D surfels;
uniform mat4 projectionMatrix;
uniform mat4 modelViewMatrix;
uniform float viewportHeight;
// Now, in units of age.
uniform float nowUnits;
uniform vec2 heightCut;
${HAZARD_UNIFORMS}
// Chunk, and the page's number and, from bit 16 on, its surfels.
in ivec4 place;
flat out vec3 pointColour;
${HEIGHT_CUT_FUNCTION}${HAZARD_FUNCTION}
void main() {
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  gl_PointSize = 1.0;
  if (gl_VertexID >= (place.w >> 16)) return;
  int page = place.w & 0xffff;
  uvec2 surfel = texelFetch(
    surfels, ivec2((page % ${PAGES_PER_ROW}) * ${pageSurfels} + gl_VertexID, page / ${PAGES_PER_ROW}), 0).rg;
  vec3 steps = vec3(uvec3(surfel.r, surfel.r >> 10, surfel.r >> 20) & 1023u);
  vec3 world = (vec3(place.xyz) + (steps + 0.5) / ${chunkSteps.toFixed(1)}) * ${chunkM.toFixed(2)};
  if (isCut(world.z)) return;
  vec4 inView = modelViewMatrix * vec4(world, 1.0);
  float away = length(inView.xyz);
  float behind = ${BEHIND_M.toFixed(2)} + ${BEHIND_SHARE.toFixed(2)} * away;
  // An orthographic camera looks along z from everywhere.
  if (projectionMatrix[3][3] == 1.0) inView.z -= ${BEHIND_M.toFixed(2)};
  else inView.xyz *= 1.0 + behind / max(away, 0.05);
  gl_Position = projectionMatrix * inView;
  float s0 = 0.5 * viewportHeight * projectionMatrix[1][1];
  gl_PointSize = clamp(${(voxelM * 1.5).toFixed(3)} * s0 / max(gl_Position.w, 0.01), 1.0, 0.08 * viewportHeight);

  uint colour = surfel.g & 0xffffu;
  vec3 rgb = vec3(float(colour >> 11) / 31.0, float((colour >> 5) & 63u) / 63.0, float(colour & 31u) / 31.0);
  float age = (nowUnits - float(surfel.g >> 16)) * ${ageUnitS.toFixed(1)};
  float brightness = ${BRIGHTNESS.toFixed(2)} * mix(1.0, ${OLD_BRIGHTNESS.toFixed(2)}, clamp(age / ${MEMORY_OLD_S.toFixed(1)}, 0.0, 1.0));
  vec3 greyed = mix(rgb, vec3(dot(rgb, vec3(0.3, 0.59, 0.11))), ${GREYED.toFixed(2)});
  pointColour = brightness * hazardTinted(greyed, world);
}
`;

const fragmentShader = /* glsl */ `
precision mediump float;
flat in vec3 pointColour;
out vec4 fragColour;

void main() {
  fragColour = vec4(pointColour, 1.0);
}
`;

export interface MemoryUniforms extends HazardUniforms {
  surfels: { value: ExternalTexture };
  /** Height of one eye's viewport, pixels of the drawing buffer. */
  viewportHeight: { value: number };
  /** Now, in units of age. */
  nowUnits: { value: number };
  /** The lowest and the highest height in the world that is drawn, metres. */
  heightCut: { value: Vector2 };
}

export function createMemoryMaterial(surfels: ExternalTexture): {
  material: RawShaderMaterial;
  uniforms: MemoryUniforms;
} {
  const uniforms: MemoryUniforms = {
    surfels: { value: surfels },
    viewportHeight: { value: 1 },
    nowUnits: { value: 0 },
    heightCut: { value: new Vector2(-UNLIMITED_M, UNLIMITED_M) },
    ...hazardUniforms(),
  };
  const material = new RawShaderMaterial({
    glslVersion: GLSL3,
    vertexShader,
    fragmentShader,
    uniforms: { ...uniforms },
  });
  return { material, uniforms };
}
