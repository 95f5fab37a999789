/** What both shaders, of points and of surfaces, do with colours: the modes of cloud-colouring.ts, and fading. */
import { COLOUR_STOPS } from './colour-map.ts';
import { INTENSITY_LUMAS, LUMA_WEIGHTS } from './point-values.ts';
import { RING_TEXELS } from './ring-table.ts';

/**
 * Share of its brightness that the oldest point loses when colours show ages. Chosen by eye: the oldest can
 * still be seen before black.
 */
export const AGE_FADE = 0.75;

/** Adds up how far a brightness has come on each stretch of the intensity's map. */
const intensityTerms = INTENSITY_LUMAS.slice(1).map((to, i) => {
  const from = INTENSITY_LUMAS[i] as number;
  return `clamp((luma - ${from.toFixed(3)}) / ${(to - from).toFixed(3)}, 0.0, 1.0)`;
});

/** Set by PointColouring and by the view. */
export const COLOUR_UNIFORMS = /* glsl */ `
uniform float freshness;
// What colours mean: captured, height, distance, intensity, age, ring, lit (cloud-colouring.ts).
uniform int colourMode;
// The value with the first colour, and 1 / the values' span.
uniform vec2 colourRange;
// The colour of the ring at each elevation (ring-table.ts), and the lowest elevation and texels per radian; 0: no rings.
uniform sampler2D ringMap;
uniform vec2 ringScale;
uniform vec3 colourMap[${COLOUR_STOPS}];
// Height of the robot's ground in the world, metres.
uniform float groundHeight;
// The lowest and the highest height in the world that is drawn, metres.
uniform vec2 heightCut;
`;

/** Needs the uniform `freshness`. */
export const FADED = /* glsl */ `
// A picture that is no longer fed turns grey: nobody may take it for the present.
vec3 faded(vec3 rgb) {
  float grey = dot(rgb, vec3(0.3, 0.59, 0.11)) * 0.6;
  return mix(vec3(grey), rgb, freshness);
}
`;

export const COLOUR_FUNCTIONS = /* glsl */ `
// The intensity from its colour (point-values.ts).
float intensityOf(vec3 rgb) {
  float luma = 255.0 * dot(rgb, vec3(${LUMA_WEIGHTS.join(', ')}));
  return (${intensityTerms.join(' + ')}) / ${(INTENSITY_LUMAS.length - 1).toFixed(1)};
}

vec3 ringColour(vec3 rgb, vec3 fromSensor) {
  if (ringScale.y == 0.0) return rgb;
  float elevation = atan(-fromSensor.y, length(fromSensor.xz));
  int texel = clamp(int((elevation - ringScale.x) * ringScale.y), 0, ${RING_TEXELS - 1});
  return texelFetch(ringMap, ivec2(texel, 0), 0).rgb;
}

vec3 coloured(vec3 rgb, vec3 fromSensor, float height, float age) {
  // Only surfaces are lit (surface-normal.ts).
  if (colourMode == 6) return rgb;
  if (colourMode == 5) return ringColour(rgb, fromSensor);
  float value = colourMode == 1 ? height
    : colourMode == 2 ? length(fromSensor)
    : colourMode == 3 ? intensityOf(rgb)
    : age;
  float level = clamp((value - colourRange.x) * colourRange.y, 0.0, 1.0);
  if (colourMode == 4) return rgb * (1.0 - ${AGE_FADE} * level);
  float place = level * ${(COLOUR_STOPS - 1).toFixed(1)};
  int low = min(int(place), ${COLOUR_STOPS - 2});
  return mix(colourMap[low], colourMap[low + 1], place - float(low));
}
${FADED}`;
