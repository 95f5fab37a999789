/**
 * The point shader: takes int16 coordinates and 6-6-4 colours as received, and applies the frame's pose and the paper's
 * size equation.
 *
 * Size (diameter, pixels): `s0 · (1/w) · (m + |z|·k)`, where z is the depth in the capturing camera and w the clip
 * coordinate. s0 is the number of pixels that one metre at w = 1 covers in this viewport, so m + |z|·k is a size in
 * metres: the distance between neighbouring samples at depth z. k is the angle between neighbours, so that points just
 * close their gaps at any resolution, eye and density of the frame. m keeps the nearest points from vanishing.
 */
import { DataTexture, GLSL3, RawShaderMaterial, Vector2, Vector3, Vector4 } from 'three';
import { ROTATE } from './batch-pose.ts';
import { colourStops } from './colour-map.ts';
import { COLOUR_FUNCTIONS, COLOUR_UNIFORMS } from './colour-shader.ts';
import { MAX_RUNS, RUN_FIELDS } from './frame-window.ts';
import { HAZARD_FUNCTION, HAZARD_UNIFORMS } from './hazard-shader.ts';
import { type HazardUniforms, hazardUniforms } from './hazards.ts';
import { RING_TEXELS } from './ring-table.ts';
import { HEIGHT_CUT_FUNCTION, UNLIMITED_M } from './shader-features.ts';

/** m: metres added to every point's size. Chosen by eye: points of a near surface close up. */
export const SIZE_OFFSET_M = 0.002;

const vertexShader = /* glsl */ `
precision highp float;
precision highp int;
uniform mat4 projectionMatrix;
uniform mat4 modelViewMatrix;
// First vertex, first visible vertex, pose slot, unused (frame-window.ts).
uniform ivec4 runs[${MAX_RUNS}];
uniform int runCount;
// Position of the camera in the world, metres; w: the size equation's k.
uniform vec4 framePosition[2];
uniform vec4 frameOrientation[2];
// Metres of one step of a coordinate.
uniform float frameUnit[2];
uniform float viewportHeight;
uniform float sizeScale;
${COLOUR_UNIFORMS}${HAZARD_UNIFORMS}
// Seconds since the frame began to arrive.
uniform float frameAge[2];
in ivec4 position;
flat out vec3 pointColour;
flat out float pointSize;

${ROTATE}${COLOUR_FUNCTIONS}${HEIGHT_CUT_FUNCTION}${HAZARD_FUNCTION}
void main() {
  int run = runCount - 1;
  while (run > 0 && gl_VertexID < runs[run].x) run--;
  if (run < 0 || gl_VertexID < runs[run].y) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    gl_PointSize = 1.0;
    return;
  }
  int slot = runs[run].z;
  vec3 camera = vec3(position.xyz) * frameUnit[slot];
  vec3 world = rotate(frameOrientation[slot], camera) + framePosition[slot].xyz;
  if (isCut(world.z)) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    gl_PointSize = 1.0;
    return;
  }
  gl_Position = projectionMatrix * (modelViewMatrix * vec4(world, 1.0));

  float s0 = 0.5 * viewportHeight * projectionMatrix[1][1];
  // Of a world that is shown as a model, points shrink with it.
  float metres = length(modelViewMatrix[0].xyz) * (${SIZE_OFFSET_M} + abs(camera.z) * framePosition[slot].w);
  pointSize = clamp(sizeScale * s0 * metres / max(gl_Position.w, 0.01), 1.0, 0.08 * viewportHeight);
  gl_PointSize = pointSize;

  uint colour = uint(position.w) & 0xffffu;
  // Bin centres of 6, 6 and 4 bits.
  vec3 rgb = vec3(
    float((colour >> 10) * 4u + 2u),
    float(((colour >> 4) & 63u) * 4u + 2u),
    float((colour & 15u) * 16u + 8u)
  ) / 255.0;
#ifdef COLOURED
  rgb = coloured(rgb, camera, world.z - groundHeight, frameAge[slot]);
#endif
  // The latency test's green has no grey in it, and no tint.
  if (colour == 0x03f0u) rgb = vec3(0.0, 1.0, 0.0);
  else rgb = hazardTinted(rgb, world);
  pointColour = faded(rgb);
}
`;

const fragmentShader = /* glsl */ `
precision mediump float;
flat in vec3 pointColour;
flat in float pointSize;
out vec4 fragColour;

void main() {
  // Below 3 pixels a disc is a square with holes.
  vec2 offset = gl_PointCoord - 0.5;
  if (pointSize > 3.0 && dot(offset, offset) > 0.25) discard;
  fragColour = vec4(pointColour, 1.0);
}
`;

export interface PointUniforms extends HazardUniforms {
  runs: { value: Int32Array };
  runCount: { value: number };
  framePosition: { value: Vector4[] };
  frameOrientation: { value: Vector4[] };
  frameUnit: { value: number[] };
  /** Height of one eye's viewport, pixels of the drawing buffer. */
  viewportHeight: { value: number };
  /** Scale for the operator's preference, 1 = as computed. */
  sizeScale: { value: number };
  /** From 1 (live) to 0 (no points are arriving). */
  freshness: { value: number };
  /** Index in the list of colour modes (cloud-colouring.ts). */
  colourMode: { value: number };
  /** The value with the first colour, and 1 / the values' span. */
  colourRange: { value: Vector2 };
  colourMap: { value: Vector3[] };
  /** The colour of the ring at each elevation. */
  ringMap: { value: DataTexture };
  /** The lowest elevation, radians, and texels per radian; 0: no rings are known. */
  ringScale: { value: Vector2 };
  /** Height of the robot's ground in the world, metres. */
  groundHeight: { value: number };
  /** The lowest and the highest height in the world that is drawn, metres. */
  heightCut: { value: Vector2 };
  /** Seconds since each frame began to arrive. */
  frameAge: { value: number[] };
}

export function createPointMaterial(): { material: RawShaderMaterial; uniforms: PointUniforms } {
  const uniforms: PointUniforms = {
    runs: { value: new Int32Array(MAX_RUNS * RUN_FIELDS) },
    runCount: { value: 0 },
    framePosition: { value: [new Vector4(), new Vector4()] },
    frameOrientation: { value: [new Vector4(0, 0, 0, 1), new Vector4(0, 0, 0, 1)] },
    frameUnit: { value: [0.001, 0.001] },
    viewportHeight: { value: 1 },
    sizeScale: { value: 1 },
    freshness: { value: 1 },
    colourMode: { value: 0 },
    colourRange: { value: new Vector2(0, 1) },
    colourMap: { value: colourStops().map(([red, green, blue]) => new Vector3(red, green, blue)) },
    ringMap: { value: ringTexture() },
    ringScale: { value: new Vector2(0, 0) },
    groundHeight: { value: 0 },
    heightCut: { value: new Vector2(-UNLIMITED_M, UNLIMITED_M) },
    frameAge: { value: [0, 0] },
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

/**
 * k of the size equation: the distance between neighbours at a depth of 1 m, metres.
 *
 * @param points number of points of the frame
 * @param imageExtent side of the camera's picture at 1 m, metres (image-extent.ts)
 * @param cover diameter of a point in mean distances
 */
export function spacingPerMetre(points: number, imageExtent: number, cover: number): number {
  return points > 0 ? (cover * imageExtent) / Math.sqrt(points) : 0;
}

/** The ring table (ring-table.ts) for the shader: one row of bytes R, G, B, A, never interpolated. */
function ringTexture(): DataTexture {
  return new DataTexture(new Uint8Array(RING_TEXELS * 4), RING_TEXELS, 1);
}
