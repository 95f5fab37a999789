/**
 * Sine and cosine from additions and multiplications alone. `Math.sin` may differ in its last bit between engines.
 * These functions, and with them the whole simulation, give the same bits everywhere.
 */

import type { Quaternion } from '@farpoint/protocol';

const HALF_PI = Math.PI / 2;

/** Taylor polynomials, accurate to 1e-16 for |x| ≤ π/4. */
function sinNearZero(x: number): number {
  const s = x * x;
  return (
    x *
    (1 +
      s *
        (-1 / 6 + s * (1 / 120 + s * (-1 / 5040 + s * (1 / 362880 + s * (-1 / 39916800 + s / 6227020800))))))
  );
}

function cosNearZero(x: number): number {
  const s = x * x;
  return (
    1 +
    s *
      (-1 / 2 +
        s *
          (1 / 24 +
            s * (-1 / 720 + s * (1 / 40320 + s * (-1 / 3628800 + s * (1 / 479001600 - s / 87178291200))))))
  );
}

/** Sine of an angle in radians, meant for |x| below a few thousand. */
export function sin(x: number): number {
  const quarter = Math.round(x / HALF_PI);
  const rest = x - quarter * HALF_PI;
  switch (((quarter % 4) + 4) % 4) {
    case 0:
      return sinNearZero(rest);
    case 1:
      return cosNearZero(rest);
    case 2:
      return -sinNearZero(rest);
    default:
      return -cosNearZero(rest);
  }
}

/** Cosine of an angle in radians, meant for |x| below a few thousand. */
export function cos(x: number): number {
  return sin(x + HALF_PI);
}

/** The same angle in (−π, π]. */
export function wrapAngle(x: number): number {
  const wrapped = x - 2 * Math.PI * Math.round(x / (2 * Math.PI));
  return wrapped <= -Math.PI ? wrapped + 2 * Math.PI : wrapped;
}

/** A rotation by `yaw` about z. */
export function fromYaw(yaw: number): Quaternion {
  return { x: 0, y: 0, z: sin(yaw / 2), w: cos(yaw / 2) };
}
