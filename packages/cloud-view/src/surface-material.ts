/**
 * The surface shader: draws clouds on a camera's grid as a surface between neighbouring samples. It fetches the samples
 * of each tile as they were decoded (tile-textures.ts), so nothing is computed for each sample on the CPU.
 *
 * A vertex is the homogeneous point (ray + position · i, i), where i is the sample's inverse depth. It needs no division,
 * samples at infinity are ordinary, and what is interpolated is linear in the camera's picture, as colours should be.
 *
 * A surface is *torn* where inverse depth changes faster than on a plane that passes the camera at a distance of
 * {@link NEAREST_PLANE_M}, plus the sensor's noise. Seen from where the camera was, what is torn is no wider than a pixel,
 * and drawn. From elsewhere it would be a skin between near and far things: it is left out where it would be stretched.
 *
 * Where the camera's own picture is there (surface-paint.ts), it takes the place of the samples' colours.
 */
import { type ExternalTexture, GLSL3, RawShaderMaterial, Vector2, Vector4 } from 'three';
import { ROTATE } from './batch-pose.ts';
import { COLOUR_FUNCTIONS, COLOUR_UNIFORMS, FADED } from './colour-shader.ts';
import { HAZARD_FUNCTION, HAZARD_UNIFORMS } from './hazard-shader.ts';
import type { PointUniforms } from './point-material.ts';
import { HEIGHT_CUT_FUNCTION } from './shader-features.ts';
import { NORMAL_FUNCTIONS } from './surface-normal.ts';
import { TILE_VERTICES } from './tile-geometry.ts';
import { FRAME_SLOTS, HIDDEN } from './tile-map.ts';
import { SLOTS_PER_ROW, TILE_SAMPLES } from './tile-textures.ts';

/** As in the decoder, which fills thinned tiles in by the same rule. */
const NEAREST_PLANE_M = 0.2;
/**
 * Noise of neighbouring samples' inverse depth, as a share of it. Chosen: above a stereo camera's
 * (docs/drawing.md).
 */
const NOISE = 0.02;
/**
 * What is torn is left out where it covers this number of times the area that its samples had in the camera's
 * picture. Chosen by eye.
 */
const MOST_STRETCH = 6;

const vertexShader = /* glsl */ `
precision highp float;
precision highp int;
uniform highp usampler2D tileSamples;
uniform highp usampler2D tileSlots;
uniform mat4 projectionMatrix;
uniform mat4 modelViewMatrix;
// Columns and rows of tiles, tiles in a row of the samples' texture, stride.
uniform ivec4 tileGrid;
// fx, fy, cx, cy, pixels.
uniform vec4 lens;
// Position of each slot's camera in the world, metres; w: seconds since its frame began to arrive.
uniform vec4 tilePosition[${FRAME_SLOTS}];
uniform vec4 tileOrientation[${FRAME_SLOTS}];
// Of each slot the layer of its frame's picture, and half of the weight that the picture has.
uniform vec4 tilePaint[${FRAME_SLOTS / 4}];
uniform float viewportHeight;
${COLOUR_UNIFORMS}
// Place in the camera's picture, pixels, of this vertex and of the upper left one of its cell.
out vec2 pixel;
flat out vec2 corner;
// Bit 0 and 1: all samples of the cell's upper right and lower left triangle were seen; 2 and 3: it is torn.
flat out int cell;
// Least pixels of the camera's picture in one of this picture, as areas, where the cell is torn.
flat out float leastPixels;
// Layer of the picture, its weight, and 0 where the surface has the latency test's green.
flat out vec3 paint;
out vec3 surfaceColour;
// Place in the world, times the inverse depth, and the inverse depth.
out vec4 place;
${ROTATE}${COLOUR_FUNCTIONS}
int slotOf(int tile) {
  return int(texelFetch(tileSlots, ivec2(tile % ${SLOTS_PER_ROW}, tile / ${SLOTS_PER_ROW}), 0).r);
}

uint sampleOf(int tile, int x, int y) {
  ivec2 at = ivec2((tile % tileGrid.z) * ${TILE_SAMPLES} + y * 16 + x, tile / tileGrid.z);
  return texelFetch(tileSamples, at, 0).r;
}

float inverseOf(uint texel) {
  return unpackHalf2x16(texel & 0xffffu).x;
}

float limitOf(float inverse, float pixels) {
  return pixels / (lens.x * ${NEAREST_PLANE_M.toFixed(2)}) + ${NOISE} * inverse;
}

// The inverse depth at x, y of 0 to 16, and the sample that has its colour. Beyond the tile's edge it is the next tile's
// of the same frame, or else what the tile's own surface goes on as.
float sampleAt(int tile, int slot, int x, int y, out uint texel) {
  ivec2 over = ivec2(x >> 4, y >> 4);
  if (over == ivec2(0)) {
    texel = sampleOf(tile, x, y);
    return inverseOf(texel);
  }
  ivec2 next = ivec2(tile % tileGrid.x, tile / tileGrid.x) + over;
  if (next.x < tileGrid.x && next.y < tileGrid.y) {
    int other = next.y * tileGrid.x + next.x;
    if (slotOf(other) == slot) {
      texel = sampleOf(other, x & 15, y & 15);
      return inverseOf(texel);
    }
  }
  ivec2 edge = min(ivec2(x, y), 15);
  texel = sampleOf(tile, edge.x, edge.y);
  float own = inverseOf(texel);
  float inner = inverseOf(sampleOf(tile, edge.x - over.x, edge.y - over.y));
  float change = own - inner;
  bool goesOn = own > 0.0 && inner > 0.0 && abs(change) < limitOf(own, 2.0);
  return goesOn ? max(own + change, 0.5 * own) : own;
}

${NORMAL_FUNCTIONS}
// Of three samples: bit 0 all were seen, bit 2 torn.
int triangleOf(float a, float b, float c) {
  float low = min(a, min(b, c));
  float high = max(a, max(b, c));
  float pixels = 2.0 * float(tileGrid.w);
  return int(low > 0.0) | (int(high - low > limitOf(high, pixels)) << 2);
}

void main() {
  int tile = gl_InstanceID;
  int slot = slotOf(tile);
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  if (slot == ${HIDDEN}) return;
  ivec2 at = ivec2(gl_VertexID % ${TILE_VERTICES}, gl_VertexID / ${TILE_VERTICES});
  uint texel;
  float inverse = sampleAt(tile, slot, at.x, at.y, texel);
  pixel = vec2(ivec2(tile % tileGrid.x, tile / tileGrid.x) * 16 + at);
  corner = pixel;
  cell = 0;
  if (at.x < 16 && at.y < 16) {
    uint unused;
    int stride = tileGrid.w;
    float right = sampleAt(tile, slot, at.x + stride, at.y, unused);
    float below = sampleAt(tile, slot, at.x, at.y + stride, unused);
    float opposite = sampleAt(tile, slot, at.x + stride, at.y + stride, unused);
    cell = triangleOf(inverse, right, opposite) | (triangleOf(inverse, below, opposite) << 1);
  }
  vec4 pose = tilePosition[slot];
  vec3 ray = vec3((pixel - lens.zw) / lens.xy, 1.0);
  vec3 direction = rotate(tileOrientation[slot], ray);
  vec4 world = vec4(direction + pose.xyz * inverse, inverse);
  gl_Position = projectionMatrix * (modelViewMatrix * world);
  place = world;
  // A metre at a depth of 1 m covers this in this picture; gl_Position.w is how many times as far away the eye is, in a
  // world that may be a model.
  float s0 = 0.5 * viewportHeight * projectionMatrix[1][1];
  float nominal = gl_Position.w / (s0 * length(modelViewMatrix[0].xyz));
  leastPixels = lens.x * lens.y * nominal * nominal / ${MOST_STRETCH.toFixed(1)};

  float painted = tilePaint[slot >> 2][slot & 3];
  paint = vec3(floor(painted), 2.0 * fract(painted), 1.0);
  uint colour = texel >> 16;
  vec3 rgb = vec3(float(colour >> 11) / 31.0, float((colour >> 5) & 63u) / 63.0, float(colour & 31u) / 31.0);
#ifdef COLOURED
  paint.y = 0.0;
  float depth = 1.0 / max(inverse, 1e-4);
  rgb = coloured(rgb, ray * depth, world.z * depth - groundHeight, pose.w);
#endif
#ifdef LIT
  if (inverse > 0.0) {
    vec3 normal = rotate(tileOrientation[slot], normalAt(tile, slot, at, inverse, ray));
    // An orthographic camera looks along z from everywhere.
    vec3 fromEye = projectionMatrix[3][3] == 1.0 ? vec3(0.0, 0.0, -1.0) : (modelViewMatrix * world).xyz;
    rgb *= litBy(mat3(modelViewMatrix) * normal, fromEye);
  }
#endif
  // The latency test's green has no grey in it, and no tint.
  if (colour == 0x07e0u) {
    rgb = vec3(0.0, 1.0, 0.0);
    paint.yz = vec2(0.0);
  }
  surfaceColour = rgb;
}
`;

const fragmentShader = /* glsl */ `
precision highp float;
precision highp int;
uniform highp sampler2DArray pictures;
// Of the image that the samples lie on, pixels.
uniform vec2 gridSize;
uniform float freshness;
uniform vec2 heightCut;
${HAZARD_UNIFORMS}
in vec2 pixel;
flat in vec2 corner;
flat in int cell;
flat in float leastPixels;
flat in vec3 paint;
in vec3 surfaceColour;
in vec4 place;
out vec4 fragColour;
${FADED}${HEIGHT_CUT_FUNCTION}${HAZARD_FUNCTION}
void main() {
  vec2 across = dFdx(pixel);
  vec2 down = dFdy(pixel);
  vec2 inCell = pixel - corner;
  int state = inCell.x > inCell.y ? cell : cell >> 1;
  if ((state & 1) == 0) discard;
  float pixels = abs(across.x * down.y - across.y * down.x);
  if ((state & 4) != 0 && pixels < leastPixels) discard;
  vec3 world = place.xyz / place.w;
  if (isCut(world.z)) discard;
  vec3 picture = texture(pictures, vec3((pixel + 0.5) / gridSize, paint.x)).rgb;
  vec3 rgb = mix(surfaceColour, picture, paint.y);
  if (paint.z > 0.0) rgb = hazardTinted(rgb, world);
  fragColour = vec4(faded(rgb), 1.0);
}
`;

/** How a surface is painted with its camera's pictures. */
export interface PaintUniforms {
  /** The pictures, a layer each. */
  pictures: { value: ExternalTexture | null };
  /** Of the image that the samples lie on, pixels. */
  gridSize: { value: Vector2 };
  /** Of each slot, four in a vector, the layer of its frame's picture, and half of the weight that the picture has. */
  tilePaint: { value: Vector4[] };
}

export interface SurfaceUniforms extends PaintUniforms {
  tileSamples: { value: ExternalTexture | null };
  tileSlots: { value: ExternalTexture | null };
  /** Columns and rows of tiles, tiles in a row of the samples' texture, stride. */
  tileGrid: { value: Int32Array };
  /** fx, fy, cx, cy, pixels. */
  lens: { value: Vector4 };
  /** Position of each slot's camera in the world, metres; w: seconds since its frame began to arrive. */
  tilePosition: { value: Vector4[] };
  /** Orientation of each slot's camera, a unit quaternion. */
  tileOrientation: { value: Vector4[] };
}

/** @param points the uniforms that surfaces share with points */
export function createSurfaceMaterial(points: PointUniforms): {
  material: RawShaderMaterial;
  uniforms: SurfaceUniforms;
} {
  const vectors = () => Array.from({ length: FRAME_SLOTS }, () => new Vector4(0, 0, 0, 1));
  const uniforms: SurfaceUniforms = {
    tileSamples: { value: null },
    tileSlots: { value: null },
    tileGrid: { value: new Int32Array(4) },
    lens: { value: new Vector4(1, 1, 0, 0) },
    tilePosition: { value: vectors() },
    tileOrientation: { value: vectors() },
    pictures: { value: null },
    gridSize: { value: new Vector2(1, 1) },
    tilePaint: { value: Array.from({ length: FRAME_SLOTS / 4 }, () => new Vector4()) },
  };
  const { viewportHeight, freshness, colourMode, colourRange, colourMap, ringMap, ringScale } = points;
  const { groundHeight, heightCut, hazardBase, hazardUp, hazardBand } = points;
  const material = new RawShaderMaterial({
    glslVersion: GLSL3,
    vertexShader,
    fragmentShader,
    uniforms: {
      ...uniforms,
      viewportHeight,
      freshness,
      colourMode,
      colourRange,
      colourMap,
      ringMap,
      ringScale,
      groundHeight,
      heightCut,
      hazardBase,
      hazardUp,
      hazardBand,
    },
  });
  return { material, uniforms };
}
