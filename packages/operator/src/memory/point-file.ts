/** What files of point clouds have in common: what is read of them, and what is written. */
import { CHUNK_M, CHUNK_STEPS, PAGE_SURFELS } from './memory-layout.ts';
import type { SurfelStore } from './surfel-store.ts';

/** How a memory can be saved: PLY and PCD as binary, and PCD as text. */
export const POINT_FILE_FORMATS = ['ply', 'pcd', 'pcd-text'] as const;
/** How a memory can be saved. */
export type PointFileFormat = (typeof POINT_FILE_FORMATS)[number];

/** No header of a point cloud is longer. */
export const MAX_HEADER = 4096;
/** Files with more are refused, before anything is allocated. */
export const MAX_POINTS = 1 << 24;
/** In a comment, before the time at which the file was written. */
export const SAVED = 'saved';
/** What has no colour is grey, 0–255. */
export const NO_COLOUR = 160;

/** Why a file is refused. */
export class PointFileError extends Error {
  override readonly name = 'PointFileError';
}

/** What was read. */
export class FilePoints {
  count = 0;
  /** x, y, z of each, metres. */
  readonly places: Float32Array;
  /** 5-6-5 bits, R highest. */
  readonly colours: Uint16Array;
  /** Seconds since it was last seen, when the file was written; 0 where the file does not say. */
  readonly agesS: Float32Array;
  /** When it was written, ISO 8601; `null` if the file does not say. */
  readonly savedAt: string | null;

  /** @param most so many may be added */
  constructor(most: number, savedAt: string | null) {
    this.places = new Float32Array(most * 3);
    this.colours = new Uint16Array(most);
    this.agesS = new Float32Array(most);
    this.savedAt = savedAt;
  }

  /** Adds a point, unless its place is none. @param red, green, blue 0–255 @param ageS NaN where it is not known */
  add(x: number, y: number, z: number, red: number, green: number, blue: number, ageS: number): void {
    if (!Number.isFinite(x + y + z)) return;
    const { count } = this;
    this.places[count * 3] = x;
    this.places[count * 3 + 1] = y;
    this.places[count * 3 + 2] = z;
    this.colours[count] = ((red >> 3) << 11) | ((green >> 2) << 5) | (blue >> 3);
    this.agesS[count] = Number.isFinite(ageS) ? Math.max(ageS, 0) : 0;
    this.count++;
  }
}

/** How many points a memory's file has: its confirmed surfels. */
export function keptPoints(store: SurfelStore): number {
  let points = 0;
  for (let surfel = 0; surfel < store.sightings.length; surfel++) points += Number(isKept(store, surfel));
  return points;
}

/** Takes a point's x, y, z in metres, its colour as 24 bits, R highest, and when it was last seen, ticks. */
export type PointSink = (x: number, y: number, z: number, rgb: number, seen: number) => void;

/** Hands out the points that a memory's file has. */
export function eachKeptPoint(store: SurfelStore, take: PointSink): void {
  const metres = (corner: number, steps: number) => (corner + (steps + 0.5) / CHUNK_STEPS) * CHUNK_M;
  for (let surfel = 0; surfel < store.sightings.length; surfel++) {
    if (!isKept(store, surfel)) continue;
    const chunk = store.pageChunks[Math.floor(surfel / PAGE_SURFELS)] as number;
    const place = store.places[surfel] as number;
    take(
      metres(store.chunkX[chunk] as number, place & 1023),
      metres(store.chunkY[chunk] as number, (place >>> 10) & 1023),
      metres(store.chunkZ[chunk] as number, place >>> 20),
      rgbOf(store.colours[surfel] as number),
      store.seen[surfel] as number,
    );
  }
}

/** 24 bits of 5-6-5 bits. */
function rgbOf(colour: number): number {
  const red = Math.round(((colour >> 11) * 255) / 31);
  const green = Math.round((((colour >> 5) & 63) * 255) / 63);
  const blue = Math.round(((colour & 31) * 255) / 31);
  return (red << 16) | (green << 8) | blue;
}

function isKept(store: SurfelStore, surfel: number): boolean {
  const page = Math.floor(surfel / PAGE_SURFELS);
  const inUse =
    (store.pageChunks[page] as number) >= 0 && surfel % PAGE_SURFELS < (store.pageCounts[page] as number);
  return inUse && (store.sightings[surfel] as number) > 1;
}
