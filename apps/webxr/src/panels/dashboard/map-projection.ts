/** Places on the map and on the screen. Metres east and north of an origin, or along the robot's world axes. */
import { marked } from '../../words/numbers.ts';

/** Which direction of the world is up on the screen. */
export type MapUp = 'x' | 'north';

export interface MapPlace {
  readonly x: number;
  readonly y: number;
}

/** Circumference of the earth at the equator, m (WGS 84, spherical Mercator). */
const EQUATOR_M = 40_075_016.686;
/** Mercator ends here, degrees. */
const MOST_LATITUDE = 85.05;
const LEAST_SCALE = 0.002;
const MOST_SCALE = 2000;

/** What the map shows: the place in its middle, its scale and its orientation. */
export class MapProjection {
  centre: MapPlace = { x: 0, y: 0 };
  up: MapUp = 'north';
  width = 1;
  height = 1;
  #metresPerPixel = 0.02;

  get metresPerPixel(): number {
    return this.#metresPerPixel;
  }

  /** On the screen, pixels from the top left. */
  toScreen({ x, y }: MapPlace): { left: number; top: number } {
    const [dx, dy] = [(x - this.centre.x) / this.#metresPerPixel, (y - this.centre.y) / this.#metresPerPixel];
    // North up: x to the right, y up. x up: y to the left.
    return this.up === 'north'
      ? { left: this.width / 2 + dx, top: this.height / 2 - dy }
      : { left: this.width / 2 - dy, top: this.height / 2 - dx };
  }

  toPlace(left: number, top: number): MapPlace {
    const [dx, dy] = [
      (left - this.width / 2) * this.#metresPerPixel,
      (top - this.height / 2) * this.#metresPerPixel,
    ];
    return this.up === 'north'
      ? { x: this.centre.x + dx, y: this.centre.y - dy }
      : { x: this.centre.x - dy, y: this.centre.y - dx };
  }

  /** The direction of a heading on the screen, radians clockwise from upwards. */
  screenAngle(yaw: number): number {
    return this.up === 'north' ? Math.PI / 2 - yaw : -yaw;
  }

  pan(dx: number, dy: number): void {
    this.centre = this.toPlace(this.width / 2 - dx, this.height / 2 - dy);
  }

  /** @param factor above 1: closer @param at what stays in its place on the screen; the middle by default */
  zoom(factor: number, at = { left: this.width / 2, top: this.height / 2 }): void {
    const place = this.toPlace(at.left, at.top);
    this.#metresPerPixel = Math.min(Math.max(this.#metresPerPixel / factor, LEAST_SCALE), MOST_SCALE);
    const now = this.toPlace(at.left, at.top);
    this.centre = { x: this.centre.x + place.x - now.x, y: this.centre.y + place.y - now.y };
  }
}

/** The largest of 1, 2, 5, 10, … that is not above `most`. */
export function roundLength(most: number): number {
  const power = 10 ** Math.floor(Math.log10(most));
  const digit = most / power;
  return (digit >= 5 ? 5 : digit >= 2 ? 2 : 1) * power;
}

export function lengthText(metres: number): string {
  if (metres >= 1000) return `${marked(String(metres / 1000))} km`;
  return metres >= 1 ? `${marked(String(metres))} m` : `${Math.round(metres * 100)} cm`;
}

/** Metres east and north of an origin, on the Mercator map with the origin's scale: what tiles are drawn in. */
export class EarthPlane {
  readonly #x: number;
  readonly #y: number;
  /** Metres for the whole width of the world map. */
  readonly worldM: number;

  constructor(latitude: number, longitude: number) {
    this.worldM = EQUATOR_M * Math.cos((clampLatitude(latitude) * Math.PI) / 180);
    [this.#x, this.#y] = mercator(latitude, longitude);
  }

  toPlace(latitude: number, longitude: number): MapPlace {
    const [x, y] = mercator(latitude, longitude);
    return { x: (x - this.#x) * this.worldM, y: (this.#y - y) * this.worldM };
  }

  /** On the world map: 0 to 1 from the west and from the north. */
  toWorld({ x, y }: MapPlace): [number, number] {
    return [this.#x + x / this.worldM, this.#y - y / this.worldM];
  }

  ofWorld(x: number, y: number): MapPlace {
    return { x: (x - this.#x) * this.worldM, y: (this.#y - y) * this.worldM };
  }
}

function clampLatitude(latitude: number): number {
  return Math.min(Math.max(latitude, -MOST_LATITUDE), MOST_LATITUDE);
}

function mercator(latitude: number, longitude: number): [number, number] {
  const tangent = Math.tan((clampLatitude(latitude) * Math.PI) / 180);
  return [(longitude + 180) / 360, (1 - Math.asinh(tangent) / Math.PI) / 2];
}
