/**
 * The robot's map of what is free and what is occupied: `map` on the `telemetry` channel, some tiles in each message.
 * Each message can be used by itself, so a lost one costs its own tiles until they are repeated.
 */
import * as z from 'zod/mini';
import { uint32Schema } from './identifiers.ts';
import { navigationTopicSchema, placeSchema } from './planned-path.ts';

/** Cells along a tile's side; tiles at the map's far edges may have fewer. */
export const MAP_TILE = 32;
/** Cells along a map's side at most. */
export const MAX_MAP_SIDE = 512;
/** In one message. */
const MAX_TILES = 64;
/** A run of equal cells is a byte: two bits of their state, six of their number less one. */
const MOST_RUN = 64;
const STATE_SHIFT = 6;
const RUNS = /^(?:[A-Za-z0-9+/]{4})*(?:[A-Za-z0-9+/]{2}==|[A-Za-z0-9+/]{3}=)?$/;
/** Base64 of as many bytes as the tile has cells. */
const MAX_RUNS = 1368;

/** A cell's state, by its number. */
export const mapCells = [
  'unknown', // nobody has seen it
  'free',
  'uncertain', // between free and occupied, as a costmap's inflated cells
  'occupied',
] as const;

/** Size of a map, in cells. */
export interface MapSize {
  width: number;
  height: number;
}

/** Some tiles of the robot's map. */
export interface MapTiles {
  type: 'map';
  /** The topic that it comes from. */
  topic: string;
  /** Changes whenever place, size or cells' size change: tiles of another number belong to another map. Wraps at 2³². */
  number: number;
  /** When the robot received the map that these tiles are of, by its monotonic clock, ms. */
  timeMs: number;
  /** Time since then, ms. */
  ageMs: number;
  /** Cells along x, at most 512. */
  width: number;
  /** Cells along y, at most 512. */
  height: number;
  /** Side of a cell, metres. */
  cellM: number;
  /** Pose in the world of the outer corner of the first cell: metres, and radians around z. */
  origin: {
    /** Forward. */
    x: number;
    /** To the left. */
    y: number;
    /** Counter-clockwise. */
    yaw: number;
  };
  /** Position of a tile, row by row from the first cell's corner, and its cells as runs, base64. */
  tiles: [index: number, runs: string][];
}

/** Where a tile lies in its map, cells. */
export interface TileExtent extends MapSize {
  x: number;
  y: number;
}

/** Number of tiles of a map. */
export function tileCount({ width, height }: MapSize): number {
  return Math.ceil(width / MAP_TILE) * Math.ceil(height / MAP_TILE);
}

/** @param index 0 to {@link tileCount} − 1 */
export function tileExtent({ width, height }: MapSize, index: number): TileExtent {
  const across = Math.ceil(width / MAP_TILE);
  const [x, y] = [(index % across) * MAP_TILE, Math.floor(index / across) * MAP_TILE];
  return { x, y, width: Math.min(MAP_TILE, width - x), height: Math.min(MAP_TILE, height - y) };
}

/**
 * The runs of a tile.
 *
 * @param cells states of all cells of the map, 0 to 3, row by row
 */
export function tileRuns(map: MapSize, index: number, cells: Uint8Array): string {
  const { x, y, width, height } = tileExtent(map, index);
  let text = '';
  let [state, run] = [-1, 0];
  const end = () => {
    if (run > 0) text += String.fromCharCode((state << STATE_SHIFT) | (run - 1));
  };
  for (let row = y; row < y + height; row++) {
    for (let column = x; column < x + width; column++) {
      const cell = cells[row * map.width + column] as number;
      if (cell === state && run < MOST_RUN) {
        run++;
        continue;
      }
      end();
      [state, run] = [cell, 1];
    }
  }
  end();
  return btoa(text);
}

/**
 * Writes a tile's cells into those of the map.
 *
 * @param runs of a message that was checked
 * @param cells states of all cells of the map, row by row
 */
export function writeTile(map: MapSize, index: number, runs: string, cells: Uint8Array): void {
  const { x, y, width } = tileExtent(map, index);
  const bytes = atob(runs);
  let at = 0;
  for (let i = 0; i < bytes.length; i++) {
    const byte = bytes.charCodeAt(i);
    for (let end = at + runLength(byte); at < end; at++)
      cells[(y + Math.floor(at / width)) * map.width + x + (at % width)] = byte >> STATE_SHIFT;
  }
}

function runLength(byte: number): number {
  return (byte & (MOST_RUN - 1)) + 1;
}

/** Whether each tile is one of the map and its runs have as many cells as it. */
function areTiles({ tiles, ...map }: MapSize & Pick<MapTiles, 'tiles'>): boolean {
  return tiles.every(([index, runs]) => {
    if (index >= tileCount(map) || !RUNS.test(runs)) return false;
    const { width, height } = tileExtent(map, index);
    const bytes = atob(runs);
    let cells = 0;
    for (let i = 0; i < bytes.length; i++) cells += runLength(bytes.charCodeAt(i));
    return cells === width * height;
  });
}

const side = z.int().check(z.minimum(1), z.maximum(MAX_MAP_SIDE));
const nonNegative = z.number().check(z.minimum(0));

export const mapTilesSchema = z
  .strictObject({
    type: z.literal('map'),
    topic: navigationTopicSchema,
    number: uint32Schema,
    timeMs: nonNegative,
    ageMs: nonNegative,
    width: side,
    height: side,
    cellM: z.number().check(z.minimum(0.001), z.maximum(1000)),
    origin: z.strictObject({
      x: placeSchema,
      y: placeSchema,
      yaw: z.number().check(z.minimum(-Math.PI), z.maximum(Math.PI)),
    }),
    tiles: z
      .array(z.tuple([z.int().check(z.minimum(0)), z.string().check(z.maxLength(MAX_RUNS))]))
      .check(z.maxLength(MAX_TILES)),
  })
  .check(
    z.refine(areTiles, {
      path: ['tiles'],
      error: 'must be tiles of the map, each with runs of all its cells',
    }),
  ) satisfies z.ZodMiniType<MapTiles>;
