/** Reads a fence from a GeoJSON file (RFC 7946), or from the same with metres in place of degrees. */
import * as z from 'zod';
import type { Area, Place } from './area.ts';
import { EarthFrame, type EarthOrigin } from './earth-frame.ts';
import type { Fence, SlowArea } from './fence.ts';

/** Together, so that every command can be judged in time: 0.02 ms with 100 corners (docs/geofence.md). */
export const MOST_CORNERS = 300;
const MOST_AREAS = 100;
/** A fence is around a robot: what is farther away is a mistake, m. */
const FARTHEST_M = 10_000;

/** Why a file is not a fence. */
export class FenceError extends Error {
  override readonly name = 'FenceError';
}

const number = z.number('must be a number');
const position = z
  .array(number)
  .min(2, 'must be a position of two numbers')
  .max(3, 'must be a position of two numbers');
const ring = z.array(position).min(4, 'must be a ring of four or more positions');
const rings = z.array(ring, 'must be a list of rings').min(1, 'must have a ring');
/** What is left empty in a table, as of a map's editor, is `null` in the file: as if it were not there. */
const properties = z.object(
  {
    kind: z.enum(['allowed', 'slow', 'forbidden'], 'must be allowed, slow or forbidden'),
    maxMps: number.min(0.01, 'must be 0.01 m/s or more').max(10, 'must be 10 m/s or less').nullish(),
    radiusM: number.positive('must be above zero').max(FARTHEST_M, `must be ${FARTHEST_M} or less`).nullish(),
  },
  'must have a kind',
);
const geometry = z.discriminatedUnion(
  'type',
  [
    z.object({ type: z.literal('Polygon'), coordinates: rings }),
    z.object({
      type: z.literal('MultiPolygon'),
      coordinates: z.array(rings, 'must be a list of polygons').min(1, 'must have a polygon'),
    }),
    z.object({ type: z.literal('Point'), coordinates: position }),
    z.object({
      type: z.literal('MultiPoint'),
      coordinates: z.array(position, 'must be a list of positions').min(1, 'must have a position'),
    }),
  ],
  'must be a Polygon, MultiPolygon, Point or MultiPoint',
);
const feature = z.object(
  { type: z.literal('Feature', 'must be Feature'), properties, geometry },
  'must be a Feature',
);
const collection = z.object(
  {
    type: z.literal('FeatureCollection', 'must be FeatureCollection'),
    /** Not of GeoJSON, whose positions are degrees. */
    frame: z.enum(['wgs84', 'world'], 'must be wgs84 or world').nullish(),
    features: z
      .array(feature, 'must be a list of areas')
      .min(1, 'must have an area')
      .max(MOST_AREAS, `must be at most ${MOST_AREAS} areas`),
  },
  'is not a FeatureCollection',
);

export interface ParsedFence {
  fence: Fence;
  /** The frame in which the fence is, for a file with positions on the earth. */
  earth: EarthFrame | null;
}

/**
 * @param text of the file
 * @param origin of the frame in which the robot's position is told; needed for positions on the earth. `first`: the
 *   first position of the file, with x to the east
 * @throws {FenceError} naming the place in the file
 */
export function parseFence(text: string, origin: EarthOrigin | 'first' | null): ParsedFence {
  const file = read(text);
  const isEarth = file.frame !== 'world';
  const earth = isEarth ? new EarthFrame(originOf(file, origin)) : null;
  const fence = { allowed: [] as Area[], forbidden: [] as Area[], slow: [] as SlowArea[], radiusM: null };
  let [corners, areas] = [0, 0];
  for (const [i, { geometry, properties }] of file.features.entries()) {
    const { kind, maxMps, radiusM } = properties;
    const where = `features[${i}]`;
    const place: PlaceOf = (at, path) => toPlace(at, earth, `${where}.geometry.${path}`);
    const drawn = areasOf(geometry, radiusM ?? null, where, place);
    areas += drawn.length;
    for (const area of drawn)
      if (area.shape === 'polygon') corners += area.rings.reduce((sum, { length }) => sum + length, 0);
    if (kind === 'slow') {
      if (typeof maxMps !== 'number')
        throw new FenceError(`${where}.properties.maxMps: is needed for a slow area`);
      fence.slow.push(...drawn.map((area) => ({ area, maxMps })));
    } else {
      if (typeof maxMps === 'number')
        throw new FenceError(`${where}.properties.maxMps: is for a slow area only`);
      fence[kind].push(...drawn);
    }
  }
  if (corners > MOST_CORNERS)
    throw new FenceError(`has ${corners} corners; at most ${MOST_CORNERS} are allowed`);
  if (areas > MOST_AREAS) throw new FenceError(`has ${areas} areas; at most ${MOST_AREAS} are allowed`);
  return { fence, earth };
}

type Geometry = z.infer<typeof geometry>;
/** Where a position is in the robot's frame. @param path of the position in its geometry */
type PlaceOf = (at: readonly number[], path: string) => Place;

/** A geometry of several parts is as many areas. */
function areasOf(geometry: Geometry, radiusM: number | null, where: string, place: PlaceOf): Area[] {
  const { type, coordinates } = geometry;
  if (type === 'Point' || type === 'MultiPoint') {
    if (radiusM === null) throw new FenceError(`${where}.properties.radiusM: is needed for a ${type}`);
    if (type === 'Point') return [{ shape: 'circle', centre: place(coordinates, 'coordinates'), radiusM }];
    return coordinates.map((at, i) => ({ shape: 'circle', centre: place(at, `coordinates[${i}]`), radiusM }));
  }
  if (radiusM !== null) throw new FenceError(`${where}.properties.radiusM: is for a Point only`);
  if (type === 'Polygon') return [polygonOf(coordinates, 'coordinates', where, place)];
  return coordinates.map((each, i) => polygonOf(each, `coordinates[${i}]`, where, place));
}

function polygonOf(rings: readonly number[][][], path: string, where: string, place: PlaceOf): Area {
  return {
    shape: 'polygon',
    rings: rings.map((positions, r) => {
      const [first, last] = [positions[0], positions.at(-1)];
      if (first?.[0] !== last?.[0] || first?.[1] !== last?.[1])
        throw new FenceError(`${where}.geometry.${path}[${r}]: the last position must be the first`);
      return positions.slice(0, -1).map((each, p) => place(each, `${path}[${r}][${p}]`));
    }),
  };
}

type File = z.infer<typeof collection>;

function read(text: string): File {
  let json: unknown;
  try {
    json = JSON.parse(text.replace(/^\uFEFF/, ''));
  } catch {
    throw new FenceError('is not JSON');
  }
  const parsed = collection.safeParse(json);
  if (parsed.success) return parsed.data;
  const [issue] = parsed.error.issues;
  const path = (issue?.path ?? [])
    .map((key) => (typeof key === 'number' ? `[${key}]` : `.${String(key)}`))
    .join('')
    .replace(/^\./, '');
  throw new FenceError(`${path === '' ? '' : `${path}: `}${issue?.message ?? 'is not a fence'}`);
}

function originOf(file: File, origin: EarthOrigin | 'first' | null): EarthOrigin {
  if (origin === null)
    throw new FenceError(
      'has positions on the earth: it needs the place of the world’s origin (--fence-origin)',
    );
  if (origin !== 'first') return origin;
  const geometry = file.features[0]?.geometry;
  // A position is the innermost list of any geometry's coordinates.
  let at: unknown = geometry?.coordinates;
  while (Array.isArray(at) && Array.isArray(at[0])) at = at[0];
  const [longitude, latitude] = checked(at as number[], 'features[0].geometry');
  return { latitude, longitude, turnDeg: 0 };
}

/** Longitude, then latitude. */
function checked([longitude = Number.NaN, latitude = Number.NaN]: readonly number[], where: string): Place {
  if (Math.abs(longitude) <= 180 && Math.abs(latitude) <= 85) return [longitude, latitude];
  throw new FenceError(`${where}: must be longitude, then latitude, in degrees`);
}

function toPlace(at: readonly number[], earth: EarthFrame | null, where: string): Place {
  let place: Place = [at[0] ?? Number.NaN, at[1] ?? Number.NaN];
  if (earth !== null) {
    const [longitude, latitude] = checked(at, where);
    place = earth.toFrame(latitude, longitude);
  }
  if (Math.hypot(...place) <= FARTHEST_M) return place;
  throw new FenceError(`${where}: is more than ${FARTHEST_M / 1000} km from the origin`);
}
