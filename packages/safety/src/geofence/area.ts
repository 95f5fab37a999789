/** Areas on the ground, in metres of one frame. */

/** A point, m. */
export type Place = readonly [x: number, y: number];

export type Area =
  /** Rings without their last point, which is the first: the outline, then holes. */
  | { readonly shape: 'polygon'; readonly rings: readonly (readonly Place[])[] }
  | { readonly shape: 'circle'; readonly centre: Place; readonly radiusM: number };

/**
 * How far inside an area a point is: the distance to its edge, m; negative outside. No two points differ by more than
 * their distance. An outline that crosses itself encloses what is within it an odd number of times.
 */
export function depthIn(area: Area, x: number, y: number): number {
  if (area.shape === 'circle') return area.radiusM - Math.hypot(x - area.centre[0], y - area.centre[1]);
  let nearest = Number.POSITIVE_INFINITY;
  let inside = false;
  for (const ring of area.rings) {
    let [ax, ay] = ring[ring.length - 1] as Place;
    for (const [bx, by] of ring) {
      nearest = Math.min(nearest, squaredDistance(x, y, ax, ay, bx, by));
      if (ay > y !== by > y && x < ((bx - ax) * (y - ay)) / (by - ay) + ax) inside = !inside;
      [ax, ay] = [bx, by];
    }
  }
  const distance = Math.sqrt(nearest);
  return inside ? distance : -distance;
}

/** To a line from a to b. */
function squaredDistance(x: number, y: number, ax: number, ay: number, bx: number, by: number): number {
  const [dx, dy] = [bx - ax, by - ay];
  const length = dx * dx + dy * dy;
  const along = length === 0 ? 0 : ((x - ax) * dx + (y - ay) * dy) / length;
  const t = Math.min(1, Math.max(0, along));
  const [ox, oy] = [x - ax - t * dx, y - ay - t * dy];
  return ox * ox + oy * oy;
}
