import { type Area, depthIn } from './area.ts';

/** An area in which the robot may go, but slowly. */
export interface SlowArea {
  area: Area;
  maxMps: number;
}

/** Where a robot may go. Within any of the allowed areas, or anywhere if there is none; in no forbidden one. */
export interface Fence {
  allowed: readonly Area[];
  forbidden: readonly Area[];
  slow: readonly SlowArea[];
  /** In addition, no farther than this from the frame's origin, m. */
  radiusM: number | null;
}

/**
 * Distance within which everything is allowed around a point, m; it may be more. Negative where the robot may not be.
 * No two points differ by more than their distance.
 */
export function clearance({ allowed, forbidden, radiusM }: Fence, x: number, y: number): number {
  let room = Number.NEGATIVE_INFINITY;
  for (const area of allowed) room = Math.max(room, depthIn(area, x, y));
  if (allowed.length === 0) room = Number.POSITIVE_INFINITY;
  for (const area of forbidden) room = Math.min(room, -depthIn(area, x, y));
  return radiusM === null ? room : Math.min(room, radiusM - Math.hypot(x, y));
}
