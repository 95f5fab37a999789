/** Finds the floor in a recorded cloud. */
import { seeded } from './guarded-drive.ts';

export interface FloorPlane {
  /** Unit vector upwards, in the camera's optical frame. */
  up: readonly [number, number, number];
  /** Of the camera above it, metres. */
  height: number;
}

type Triple = readonly [number, number, number];

const TRIES = 800;
/** So many points are enough to judge a plane by. */
const JUDGED = 8000;
const NEAR_M = 0.02;
/** A camera on a robot looks down or up by less than this: cosine. */
const LEAST_UPRIGHT = 0.7;
/** Share of the points that a floor has at least, and of those that may lie well below it. */
const LEAST_SHARE = 0.25;
const MOST_BELOW = 0.02;
const BELOW_M = 0.1;
/** As much as this share of the floor may lie close over or under it. */
const MOST_BESIDE = 0.5;

/** @param points x, y, z and a word each; NaN where there is none @returns `null` if no plane is one to stand on */
export function findFloor(points: Float32Array): FloorPlane | null {
  const all: Triple[] = [];
  const step = Math.max(1, Math.floor(points.length / 4 / JUDGED));
  for (let i = 0; i < points.length; i += 4 * step) {
    const [x, y, z] = [points[i] as number, points[i + 1] as number, points[i + 2] as number];
    if (z > 0 && Number.isFinite(x + y + z)) all.push([x, y, z]);
  }
  if (all.length < 3) return null;
  const random = seeded(1);
  const any = () => all[Math.floor(random() * all.length)] as Triple;
  let best: FloorPlane | null = null;
  let most = LEAST_SHARE * all.length;
  for (let i = 0; i < TRIES; i++) {
    const plane = planeThrough(any(), any(), any());
    if (plane === null) continue;
    let [on, below] = [0, 0];
    for (const point of all) {
      const above = heightOver(plane, point);
      if (Math.abs(above) < NEAR_M) on++;
      else if (above < -BELOW_M) below++;
    }
    if (on <= most || below > MOST_BELOW * all.length) continue;
    [best, most] = [plane, on];
  }
  const plane =
    best === null ? null : fitted(all.filter((point) => Math.abs(heightOver(best, point)) < NEAR_M));
  if (plane === null) return null;
  // A plane that only cuts through things has as much beside it as on it.
  const heights = all.map((point) => Math.abs(heightOver(plane, point)));
  const on = heights.filter((height) => height < NEAR_M).length;
  const beside = heights.filter((height) => height >= NEAR_M && height < BELOW_M).length;
  return beside > MOST_BESIDE * on ? null : plane;
}

function heightOver({ up, height }: FloorPlane, [x, y, z]: Triple): number {
  return up[0] * x + up[1] * y + up[2] * z + height;
}

function planeThrough(a: Triple, b: Triple, c: Triple): FloorPlane | null {
  const u = [b[0] - a[0], b[1] - a[1], b[2] - a[2]] as const;
  const v = [c[0] - a[0], c[1] - a[1], c[2] - a[2]] as const;
  const cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]] as const;
  return upright(cross, a);
}

/** The plane through a point with this normal, either way; `null` if it is too steep. */
function upright([x, y, z]: Triple, at: Triple): FloorPlane | null {
  const length = Math.hypot(x, y, z);
  if (!(length > 1e-6)) return null;
  // An optical frame's y axis points downwards.
  const sign = y > 0 ? -1 : 1;
  const up = [(sign * x) / length, (sign * y) / length, (sign * z) / length] as const;
  if (-up[1] < LEAST_UPRIGHT) return null;
  const height = -(up[0] * at[0] + up[1] * at[1] + up[2] * at[2]);
  return height > 0 ? { up, height } : null;
}

/** y = a + b·x + c·z through points of a plane that is not upright, by least squares. */
function fitted(points: readonly Triple[]): FloorPlane | null {
  const n = points.length;
  const mean = [0, 1, 2].map((axis) => points.reduce((sum, point) => sum + (point[axis] as number), 0) / n);
  const [mx, my, mz] = mean as [number, number, number];
  let [xx, xz, zz, xy, zy] = [0, 0, 0, 0, 0];
  for (const [x, y, z] of points) {
    const [dx, dy, dz] = [x - mx, y - my, z - mz];
    xx += dx * dx;
    xz += dx * dz;
    zz += dz * dz;
    xy += dx * dy;
    zy += dz * dy;
  }
  const determinant = xx * zz - xz * xz;
  const [b, c] = [(xy * zz - zy * xz) / determinant, (zy * xx - xy * xz) / determinant];
  return upright([b, -1, c], [mx, my, mz]);
}
