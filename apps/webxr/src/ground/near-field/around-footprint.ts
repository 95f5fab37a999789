/** Where something is whose direction and distance from the robot's edge are known. No three.js here. */

/** On the floor, m: x ahead of base_link, y to its left. */
export interface FloorPoint {
  readonly x: number;
  readonly y: number;
}

/** How far beyond its ends a side of the outline still counts, metres: no ray slips through between two sides. */
const SEAM_M = 1e-9;

/** Distance of a point from a convex outline, metres; 0 inside. @param outline counter-clockwise */
export function distanceFrom(outline: readonly FloorPoint[], x: number, y: number): number {
  let [isInside, least] = [true, Number.POSITIVE_INFINITY];
  for (let i = 0; i < outline.length; i++) {
    const a = outline[i] as FloorPoint;
    const b = outline[(i + 1) % outline.length] as FloorPoint;
    const [ex, ey] = [b.x - a.x, b.y - a.y];
    const [dx, dy] = [x - a.x, y - a.y];
    if (ex * dy - ey * dx < 0) isInside = false;
    const share = Math.min(1, Math.max(0, (dx * ex + dy * ey) / (ex * ex + ey * ey)));
    least = Math.min(least, Math.hypot(dx - share * ex, dy - share * ey));
  }
  return isInside ? 0 : least;
}

/** Distance of a convex outline's farthest corner from base_link, metres. */
export function reachOf(outline: readonly FloorPoint[]): number {
  return Math.max(...outline.map(({ x, y }) => Math.hypot(x, y)));
}

/** Distance of a convex outline's nearest side from base_link, metres. @param outline counter-clockwise, around base_link */
export function innerRadius(outline: readonly FloorPoint[]): number {
  return Math.min(
    ...outline.map((a, i) => {
      const b = outline[(i + 1) % outline.length] as FloorPoint;
      return (a.x * b.y - a.y * b.x) / Math.hypot(b.x - a.x, b.y - a.y);
    }),
  );
}

/**
 * How far from base_link a point is, metres: where a ray from base_link leaves the outline widened by a distance,
 * which is the union of its sides moved outwards and of discs at its corners.
 *
 * @param outline counter-clockwise, around base_link
 * @param bearing radians to the left of straight ahead @param metres from the outline, 0 or more
 */
export function radiusAt(outline: readonly FloorPoint[], bearing: number, metres: number): number {
  const c = Math.cos(bearing);
  const s = Math.sin(bearing);
  let farthest = 0;
  let a = outline[outline.length - 1] as FloorPoint;
  for (const b of outline) {
    const length = Math.sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
    const ux = (b.x - a.x) / length;
    const uy = (b.y - a.y) / length;
    // The side faces along (uy, -ux).
    const approach = c * uy - s * ux;
    if (approach > 0) {
      const radius = (a.x * uy - a.y * ux + metres) / approach;
      const along = (radius * c - a.x) * ux + (radius * s - a.y) * uy;
      if (along >= -SEAM_M && along <= length + SEAM_M && radius > farthest) farthest = radius;
    }
    const beside = b.y * c - b.x * s;
    const corner = b.x * c + b.y * s + Math.sqrt(metres * metres - beside * beside);
    // Not a number where the ray misses the corner's disc.
    if (corner > farthest) farthest = corner;
    a = b;
  }
  return farthest;
}
