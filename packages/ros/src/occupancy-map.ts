/** Reads nav_msgs/OccupancyGrid, with a bounded number of cells. */
import { compose, MAX_MAP_SIDE, MAX_PLACE_M, mapCells, type Pose } from '@farpoint/protocol';
import { occupancyGridSchema, stampNs, unitQuaternion } from './messages.ts';
import { type NavigationNews, type OccupancyMap, onFloor } from './navigation-news.ts';

/** Thresholds of Nav2's map server, percent: from here on occupied, and free up to here. */
const OCCUPIED_FROM = 65;
const FREE_TO = 25;
/** The bytes of an int8. */
const STATES = Uint8Array.from({ length: 256 }, (_, byte) => stateOf((byte << 24) >> 24));
/**
 * Which state a coarser cell takes of those that it covers, the highest rank first: it is free only if all of it is.
 * Ranks of unknown, free, uncertain and occupied.
 */
const RANK = [1, 0, 2, 3] as const;

/** A map as its navigator has it, before it is known where its frame is. */
export interface FramedMap extends Omit<OccupancyMap, 'origin'> {
  frameId: string;
  stampNs: bigint;
  /** Pose in its frame of the first cell's outer corner. */
  origin: Pose;
}

/**
 * A map with too many cells is made coarser.
 *
 * @throws {Error} if the message does not match its type
 */
export function readMap(message: unknown): FramedMap {
  const { header, info, data } = occupancyGridSchema.parse(message);
  const { width, height, resolution } = info;
  if (width === 0 || height === 0) throw new Error('the map has no cells');
  const orientation = unitQuaternion(info.origin.orientation);
  if (orientation === null) throw new Error('the orientation of the map’s origin is none');
  const factor = Math.ceil(Math.max(width, height) / MAX_MAP_SIDE);
  const [across, up] = [Math.ceil(width / factor), Math.ceil(height / factor)];
  const cells = new Uint8Array(across * up);
  // Free has the lowest rank, so that every other state takes its place.
  cells.fill(mapCells.indexOf('free'));
  for (let y = 0; y < height; y++) {
    const row = Math.floor(y / factor) * across;
    for (let x = 0; x < width; x++) {
      const at = row + Math.floor(x / factor);
      const state = STATES[(data[y * width + x] as number) & 0xff] as 0 | 1 | 2 | 3;
      if (RANK[state] > RANK[cells[at] as 0 | 1 | 2 | 3]) cells[at] = state;
    }
  }
  return {
    frameId: header.frame_id,
    stampNs: stampNs(header.stamp),
    width: across,
    height: up,
    cellM: resolution * factor,
    cells,
    origin: { position: info.origin.position, orientation },
  };
}

/** @param framePose of the map's frame in the world; `null` if it is not known */
export function placeMap(map: FramedMap, framePose: Pose | null): NavigationNews {
  const { frameId, width, height, cellM, cells } = map;
  const refused = { kind: 'refused', of: 'map', frame: frameId } as const;
  if (framePose === null) return { ...refused, reason: 'unknown-frame' };
  const origin = onFloor(compose(framePose, map.origin));
  if (origin === null) return { ...refused, reason: 'not-level' };
  if (Math.max(Math.abs(origin.x), Math.abs(origin.y)) > MAX_PLACE_M)
    return { ...refused, reason: 'out-of-range' };
  return { kind: 'map', map: { width, height, cellM, origin, cells } };
}

/** @param value percent; -1 for unknown */
function stateOf(value: number): number {
  const state =
    value < 0 || value > 100
      ? 'unknown'
      : value >= OCCUPIED_FROM
        ? 'occupied'
        : value <= FREE_TO
          ? 'free'
          : 'uncertain';
  return mapCells.indexOf(state);
}
