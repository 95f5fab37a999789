/** The way along an arc, as far as something stays away from it. */
import type { Place } from './area.ts';

/** Where a way begins, and how it bends. */
export interface Arc {
  x: number;
  y: number;
  /** Direction of travel, rad. */
  direction: number;
  /** Change of direction along the way, rad/m. */
  bend: number;
}

/**
 * Steps that are tried. What is left after them does not count: the way is then called shorter than it is.
 * Chosen: a bound on what a command takes (docs/geofence.md).
 */
const MOST_STEPS = 48;
/** Closer is there, m. */
const CLOSE_M = 0.001;
const STRAIGHT = 1e-6;

export function placeOn({ x, y, direction, bend }: Arc, along: number): Place {
  const turned = bend * along;
  // The chord of an arc has half its turn.
  const half = turned / 2;
  const chord = Math.abs(half) < STRAIGHT ? along : (along * Math.sin(half)) / half;
  return [x + chord * Math.cos(direction + half), y + chord * Math.sin(direction + half)];
}

/**
 * How far the arc can be followed before a distance from it is used up, m; perhaps a little less than in truth.
 *
 * @param distance at a place; no two places may differ by more than their distance
 * @param spread how much of the distance travelled the robot may be beside the arc
 * @param most no farther than this is asked
 */
export function freeLength(
  arc: Arc,
  distance: (x: number, y: number) => number,
  spread: number,
  most: number,
): number {
  let along = 0;
  for (let step = 0; step < MOST_STEPS; step++) {
    const [x, y] = placeOn(arc, along);
    const room = distance(x, y) - spread * along;
    if (!(room > CLOSE_M)) return along;
    // Nothing nearer than `room` can come nearer than nothing within this length.
    along += room / (1 + spread);
    if (along >= most) return most;
  }
  return along;
}
