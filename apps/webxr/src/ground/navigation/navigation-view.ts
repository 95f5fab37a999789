/** What of the navigator's path and map is shown: only what still holds. */
import type { MapPlace, NavigatorMap, NavigatorPath } from '@farpoint/operator';

/**
 * Navigators plan anew once a second. A path that is older than this may have been left long ago, ms. Chosen:
 * five plans may be missing (docs/awareness.md).
 */
const PATH_HOLDS_MS = 5000;
/** The robot repeats its map tile by tile, at least every 4 s: a longer silence is none of a tile that was lost, ms. */
const MAP_HOLDS_MS = 15_000;
/** From then on, nothing is said of it any more, ms. Chosen: who looks away for a moment still finds it. */
const GONE_MS = 60_000;

export interface PathView {
  /** In the world, metres, from the robot to the goal. */
  readonly points: NavigatorPath['points'];
  /** Too old to be drawn. */
  readonly stale: boolean;
  readonly ageMs: number;
}

export interface MapView {
  readonly place: MapPlace;
  readonly cells: Uint8Array;
  /** Counts the changes of the cells. */
  readonly changes: number;
  /** The robot has been silent about it for too long to be drawn. */
  readonly stale: boolean;
  /** How long ago the robot received it, ms. */
  readonly ageMs: number;
  readonly silentMs: number;
}

/** `null` if there is no path, or none any more. @param nowMs page's clock */
export function pathView(path: NavigatorPath, nowMs: number): PathView | null {
  const ageMs = path.ageMs(nowMs);
  if (ageMs === null || ageMs > GONE_MS || path.points.length < 2) return null;
  return { points: path.points, stale: ageMs > PATH_HOLDS_MS, ageMs };
}

/** `null` if there is no map, or none any more. @param nowMs page's clock */
export function mapView(map: NavigatorMap, nowMs: number): MapView | null {
  const { place, cells, changes } = map;
  const [ageMs, silentMs] = [map.ageMs(nowMs), map.silentMs(nowMs)];
  if (place === null || ageMs === null || silentMs === null || silentMs > GONE_MS) return null;
  return { place, cells, changes, stale: silentMs > MAP_HOLDS_MS, ageMs, silentMs };
}
