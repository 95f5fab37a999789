/** A line on the floor as a ribbon of constant width. No three.js here. */

/**
 * Writes pairs of points, left and right of the line, into x, y, z triples; z stays. Corners are mitred, sharp ones cut.
 *
 * @param halfWidth metres
 * @param into 6 numbers for each point
 * @returns number of points that were written
 */
export function writePathRibbon(
  points: readonly (readonly [x: number, y: number])[],
  halfWidth: number,
  into: Float32Array,
): number {
  const count = Math.min(points.length, Math.floor(into.length / 6));
  let [normalX, normalY] = [0, 0];
  for (let i = 0; i < count; i++) {
    const [x, y] = points[i] as readonly [number, number];
    const before = normalOf(points[i - 1], points[i]);
    const after = normalOf(points[i], points[i + 1]);
    const [bx, by] = before ?? after ?? [normalX, normalY];
    const [ax, ay] = after ?? before ?? [normalX, normalY];
    const [sumX, sumY] = [bx + ax, by + ay];
    const squared = sumX * sumX + sumY * sumY;
    // Twice the normal's length divided by this is the mitre's; at a turn of 180° it has no end.
    const scale = 2 / Math.max(squared, 0.5);
    if (squared > 1e-9) [normalX, normalY] = [sumX * scale, sumY * scale];
    else [normalX, normalY] = [bx, by];
    into[6 * i] = x + normalX * halfWidth;
    into[6 * i + 1] = y + normalY * halfWidth;
    into[6 * i + 3] = x - normalX * halfWidth;
    into[6 * i + 4] = y - normalY * halfWidth;
  }
  return count;
}

/** To the left of the way from `a` to `b`, of length 1; `null` if there is no way. */
function normalOf(
  a: readonly [number, number] | undefined,
  b: readonly [number, number] | undefined,
): [number, number] | null {
  if (a === undefined || b === undefined) return null;
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const length = Math.hypot(dx, dy);
  return length > 1e-6 ? [-dy / length, dx / length] : null;
}
