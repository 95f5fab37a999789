/** Between places on the earth and a frame in metres that touches it. */
import type { Place } from './area.ts';

/** Where a frame's origin is on the earth, and how the frame lies. */
export interface EarthOrigin {
  /** Degrees, WGS 84. */
  latitude: number;
  longitude: number;
  /** Direction of the x axis, degrees anticlockwise from east; 0: x points east, y north. */
  turnDeg: number;
}

/** WGS 84: radius at the equator, m, and the square of the eccentricity. */
const EQUATOR_M = 6_378_137;
const ECCENTRICITY_SQUARED = 0.00669437999014;
const RADIANS = Math.PI / 180;

/** Exact to a centimetre within a kilometre of the origin, and to a metre within ten. */
export class EarthFrame {
  readonly origin: Readonly<EarthOrigin>;
  readonly #northM: number;
  readonly #eastM: number;
  readonly #cos: number;
  readonly #sin: number;

  constructor(origin: EarthOrigin) {
    this.origin = Object.freeze({ ...origin });
    const sine = Math.sin(origin.latitude * RADIANS);
    const root = Math.sqrt(1 - ECCENTRICITY_SQUARED * sine * sine);
    this.#northM = (EQUATOR_M * (1 - ECCENTRICITY_SQUARED)) / root ** 3;
    this.#eastM = (EQUATOR_M / root) * Math.cos(origin.latitude * RADIANS);
    this.#cos = Math.cos(origin.turnDeg * RADIANS);
    this.#sin = Math.sin(origin.turnDeg * RADIANS);
  }

  /** @param longitude degrees, also across the date line */
  toFrame(latitude: number, longitude: number): Place {
    const turned = longitude - this.origin.longitude;
    const east = (turned - 360 * Math.round(turned / 360)) * RADIANS * this.#eastM;
    const north = (latitude - this.origin.latitude) * RADIANS * this.#northM;
    return [east * this.#cos + north * this.#sin, north * this.#cos - east * this.#sin];
  }
}
