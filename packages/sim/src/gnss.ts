/** What a satellite receiver on the simulated robot measures, if the building stands somewhere on the earth. */

/** Degrees (WGS 84): where the world's origin is. x points east, y north. */
export interface EarthOrigin {
  latitude: number;
  longitude: number;
}

/** WGS 84: radius at the equator, m, and the square of the eccentricity. */
const EQUATOR_M = 6_378_137;
const ECCENTRICITY_SQUARED = 0.00669437999014;
const RADIANS = Math.PI / 180;

/** Latitude and longitude of a place near the origin, degrees; exact to a centimetre within a kilometre. */
export function earthPlace({ latitude, longitude }: EarthOrigin, x: number, y: number): EarthOrigin {
  const sine = Math.sin(latitude * RADIANS);
  const root = Math.sqrt(1 - ECCENTRICITY_SQUARED * sine * sine);
  const northRadius = (EQUATOR_M * (1 - ECCENTRICITY_SQUARED)) / root ** 3;
  const eastRadius = (EQUATOR_M / root) * Math.cos(latitude * RADIANS);
  return { latitude: latitude + y / northRadius / RADIANS, longitude: longitude + x / eastRadius / RADIANS };
}
