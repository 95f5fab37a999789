/**
 * How a surface is lit by its normal: a light at the eye, and some from everywhere.
 *
 * On a plane, inverse depth is linear in the camera's picture: n · P = d with P = ray / i gives i = n · ray / d. So the
 * slopes a and b of inverse depth along the ray's x and y give the normal, (a, b, i − a · ray.x − b · ray.y) in the
 * camera's optical frame, at any depth. They are fitted by least squares to the samples around a vertex. What was not
 * seen, lies beyond an edge, or is another frame's takes no part. What changes by more than the noise counts less: on a
 * plane that is so on either side alike, and where two surfaces meet, the vertex' own decides.
 */

/** How far around a vertex its neighbours are, samples: far enough that the sensor's noise tilts little. */
const REACH = 4;
/** Share of the light that comes from everywhere: edge-on surfaces stay visible. Chosen by eye. */
export const LIT_AMBIENT = 0.3;

/** Uses `slotOf`, `sampleOf`, `inverseOf`, `limitOf` and `rotate` of the surface shader. */
export const NORMAL_FUNCTIONS = /* glsl */ `
// The inverse depth at x, y, which may lie in a tile beside this one; 0: not seen, or not in this frame.
float neighbourAt(int tile, int slot, int x, int y) {
  ivec2 place = ivec2(tile % tileGrid.x, tile / tileGrid.x) + ivec2(x >> 4, y >> 4);
  if (place.x < 0 || place.y < 0 || place.x >= tileGrid.x || place.y >= tileGrid.y) return 0.0;
  int other = place.y * tileGrid.x + place.x;
  if (other != tile && slotOf(other) != slot) return 0.0;
  return inverseOf(sampleOf(other, x & 15, y & 15));
}

// The normal in the optical frame, not of length 1; as if it faced the camera where nothing is known.
vec3 normalAt(int tile, int slot, ivec2 at, float inverse, vec3 ray) {
  float most = limitOf(inverse, ${REACH.toFixed(1)});
  float noise = limitOf(inverse, 0.0);
  // Weighted sums of x², xy, y², and of x and y times the change.
  vec3 squares = vec3(0.0);
  vec2 products = vec2(0.0);
  for (int i = 0; i < 9; i++) {
    ivec2 away = (ivec2(i % 3, i / 3) - 1) * ${REACH};
    float other = i == 4 ? 0.0 : neighbourAt(tile, slot, at.x + away.x, at.y + away.y);
    float change = other - inverse;
    if (other == 0.0 || abs(change) > most) continue;
    float weight = noise * noise / (noise * noise + change * change);
    vec2 offset = vec2(away);
    squares += weight * vec3(offset.x * offset.x, offset.x * offset.y, offset.y * offset.y);
    products += weight * change * offset;
  }
  // 0 where all neighbours lie on one line.
  float determinant = squares.x * squares.z - squares.y * squares.y;
  if (determinant <= 1e-4 * squares.x * squares.z) return ray;
  vec2 slope = vec2(
    squares.z * products.x - squares.y * products.y,
    squares.x * products.y - squares.y * products.x
  ) * lens.xy / determinant;
  return vec3(slope, inverse - dot(slope, ray.xy));
}

// The share of its brightness that a surface shows. Both vectors in the eye's frame.
float litBy(vec3 normal, vec3 fromEye) {
  float facing = abs(dot(normal, fromEye)) / max(length(normal) * length(fromEye), 1e-12);
  return mix(${LIT_AMBIENT.toFixed(2)}, 1.0, facing);
}
`;
