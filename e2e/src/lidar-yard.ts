/** A revolution of a LiDAR that stands higher than its robot's poses say, in a walled yard. */
import type { Place } from './place.ts';

const RINGS = { count: 16, lowestDeg: -25, stepDeg: 1.87 };
const COLUMNS = 900;

export const lidarYard = {
  /** The sensor over the ground, metres. A cloud without a pose is shown 1 m above the floor. */
  sensorM: 1.8,
  groundM: 1 - 1.8,
  /** From the sensor to the walls. */
  wallM: 22,
} as const;

/** The cloud: x ahead, y to the left, z up, from the sensor. A few of its points are wrong. */
export function lidarYardPlaces(): Place[] {
  const { sensorM, wallM } = lidarYard;
  const places: Place[] = [];
  for (let column = 0; column < COLUMNS; column++) {
    const azimuth = (2 * Math.PI * column) / COLUMNS;
    const [x, y] = [Math.cos(azimuth), Math.sin(azimuth)];
    const toWall = wallM / Math.max(Math.abs(x), Math.abs(y));
    for (let ring = 0; ring < RINGS.count; ring++) {
      const rise = Math.tan(((RINGS.lowestDeg + ring * RINGS.stepDeg) * Math.PI) / 180);
      const level = rise < 0 ? Math.min(toWall, -sensorM / rise) : toWall;
      places.push([x * level, y * level, rise * level]);
    }
    if (column % 10 === 0) places.push([120 * x, 120 * y, -6]);
  }
  return places;
}
