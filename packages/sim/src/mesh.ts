import { cos, sin } from './trigonometry.ts';
import type { Vector } from './world.ts';

/** A point, or a direction, as three numbers. */
export type Triple = readonly [number, number, number];

/** xyz · position + w. */
export type Affine = readonly [number, number, number, number];

/** A flat convex face in its body's frame, counter-clockwise from the front, with texture coordinates. */
export interface Face {
  corners: Triple[];
  u: Affine;
  v: Affine;
}

type Side = 'front' | 'back' | 'left' | 'right' | 'top' | 'bottom';

/** Outward normal, and the directions in which u and v grow, of each side of a box. */
const SIDES: Record<Side, { normal: Triple; u: Triple; v: Triple }> = {
  front: { normal: [1, 0, 0], u: [0, 1, 0], v: [0, 0, 1] },
  back: { normal: [-1, 0, 0], u: [0, -1, 0], v: [0, 0, 1] },
  left: { normal: [0, 1, 0], u: [-1, 0, 0], v: [0, 0, 1] },
  right: { normal: [0, -1, 0], u: [1, 0, 0], v: [0, 0, 1] },
  top: { normal: [0, 0, 1], u: [1, 0, 0], v: [0, 1, 0] },
  bottom: { normal: [0, 0, -1], u: [1, 0, 0], v: [0, -1, 0] },
};

/** The six sides of a box, u and v in metres from each side's lower left corner. */
export function boxFaces(centre: Vector, size: Vector, cosYaw = 1, sinYaw = 0): [Side, Face][] {
  const turn = ([x, y, z]: Triple): Triple => [x * cosYaw - y * sinYaw, x * sinYaw + y * cosYaw, z];
  return (Object.keys(SIDES) as Side[]).map((name) => {
    const side = SIDES[name];
    const along = (axis: Triple) =>
      Math.abs(axis[0]) * size.x + Math.abs(axis[1]) * size.y + Math.abs(axis[2]) * size.z;
    const normal = turn(side.normal);
    const middle: Triple = [
      centre.x + (normal[0] * along(side.normal)) / 2,
      centre.y + (normal[1] * along(side.normal)) / 2,
      centre.z + (normal[2] * along(side.normal)) / 2,
    ];
    return [name, rectangle(middle, turn(side.u), turn(side.v), along(side.u), along(side.v))];
  });
}

/** A rectangle around `middle` whose front faces along `uAxis × vAxis`. */
export function rectangle(middle: Triple, uAxis: Triple, vAxis: Triple, width: number, height: number): Face {
  const corner = (a: number, b: number): Triple => [
    middle[0] + uAxis[0] * a * width + vAxis[0] * b * height,
    middle[1] + uAxis[1] * a * width + vAxis[1] * b * height,
    middle[2] + uAxis[2] * a * width + vAxis[2] * b * height,
  ];
  return {
    corners: [corner(-0.5, -0.5), corner(0.5, -0.5), corner(0.5, 0.5), corner(-0.5, 0.5)],
    u: [...uAxis, width / 2 - dot(uAxis, middle)],
    v: [...vAxis, height / 2 - dot(vAxis, middle)],
  };
}

/**
 * An ellipsoid as triangles. Their u is the brightness of the curved surface, lit from above and slightly from +x, so
 * that it looks round without a normal per pixel.
 */
export function ellipsoidFaces(centre: Vector, size: Vector, segments = 10, rings = 6): Face[] {
  const ringOf = (ring: number): Triple[] => {
    const polar = (Math.PI * ring) / rings;
    return Array.from({ length: segments }, (_, i): Triple => {
      const around = (2 * Math.PI * i) / segments;
      return [sin(polar) * cos(around), sin(polar) * sin(around), cos(polar)];
    });
  };
  const faces: Face[] = [];
  const add = (a: Triple, b: Triple, c: Triple) => {
    const place = (n: Triple): Triple => [
      centre.x + (n[0] * size.x) / 2,
      centre.y + (n[1] * size.y) / 2,
      centre.z + (n[2] * size.z) / 2,
    ];
    const corners = [place(a), place(b), place(c)];
    const brightness = (n: Triple) => 0.84 + 0.26 * n[2] + 0.1 * n[0] - 0.06 * n[1];
    faces.push({
      corners,
      u: affineThrough(corners, [brightness(a), brightness(b), brightness(c)]),
      v: [0, 0, 0, 0],
    });
  };
  for (let ring = 0; ring < rings; ring++) {
    const upper = ringOf(ring);
    const lower = ringOf(ring + 1);
    for (let i = 0; i < segments; i++) {
      const j = (i + 1) % segments;
      if (ring < rings - 1) add(upper[i]!, lower[i]!, lower[j]!);
      if (ring > 0) add(upper[i]!, lower[j]!, upper[j]!);
    }
  }
  return faces;
}

/** The affine function, constant along the triangle's normal, that has these values at its corners. */
function affineThrough(corners: Triple[], values: Triple): Affine {
  const [a, b, c] = corners as [Triple, Triple, Triple];
  const e = subtract(b, a);
  const f = subtract(c, a);
  const [ee, ef, ff] = [dot(e, e), dot(e, f), dot(f, f)];
  const determinant = ee * ff - ef * ef;
  const [p, q] = [values[1] - values[0], values[2] - values[0]];
  const s = (p * ff - q * ef) / determinant;
  const t = (q * ee - p * ef) / determinant;
  const g: Triple = [e[0] * s + f[0] * t, e[1] * s + f[1] * t, e[2] * s + f[2] * t];
  return [...g, values[0] - dot(g, a)];
}

function dot(a: Triple, b: Triple): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

function subtract(a: Triple, b: Triple): Triple {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}
