/** Where something is whose direction and distance from the robot's edge are known. No three.js here. */
import type { FloorPoint } from '../view/swept-path.ts';

/** Halvings of the search: to a millimetre. */
const HALVINGS = 13;

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

/**
 * How far from base_link a point is, metres.
 *
 * @param bearing radians to the left of straight ahead @param metres from the outline, which lies around base_link
 * @param reach of the outline: {@link reachOf}
 */
export function radiusAt(
  outline: readonly FloorPoint[],
  reach: number,
  bearing: number,
  metres: number,
): number {
  const [c, s] = [Math.cos(bearing), Math.sin(bearing)];
  let [near, far] = [0, reach + metres + 0.01];
  for (let i = 0; i < HALVINGS; i++) {
    const middle = (near + far) / 2;
    if (distanceFrom(outline, middle * c, middle * s) > metres) far = middle;
    else near = middle;
  }
  return (near + far) / 2;
}
