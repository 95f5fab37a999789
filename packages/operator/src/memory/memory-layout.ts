/**
 * How remembered surfaces are divided and packed. The world (REP-103, metres) is divided into *chunks*, cubes of
 * {@link CHUNK_M}; a chunk into *voxels* of {@link VOXEL_M}, each of which holds one *surfel* at most: a piece of a surface,
 * with a position, a colour and the time at which it was last seen. A chunk's surfels lie in *pages* of
 * {@link PAGE_SURFELS}, the unit in which they are handed to whoever draws them.
 */

/** Side of a voxel, metres. */
export const VOXEL_M = 0.05;
/** Voxels along a chunk's side: a power of two. */
export const CHUNK_VOXELS = 32;
/** Side of a chunk, metres. */
export const CHUNK_M = VOXEL_M * CHUNK_VOXELS;
/** Steps of a surfel's position along a chunk's side: 1.6 mm each. */
export const CHUNK_STEPS = 1024;
export const STEPS_PER_METRE = CHUNK_STEPS / CHUNK_M;
/** Surfels of a page. */
export const PAGE_SURFELS = 256;

/** Ticks of the memory's clock in a second. */
export const TICKS_PER_S = 16;
/** The memory's clock begins with so much, so that what was loaded from a file can be older than the memory, s. */
export const CLOCK_START_S = 24 * 3600;
/** Ages are handed on in units of this, s. */
export const AGE_UNIT_S = 4;

/** The most pages: 2²¹ surfels, which is a building of 30 × 30 m. */
export const PAGES = 8192;

/** What whoever draws {@link MemoryPages} must know. */
export const MEMORY_LAYOUT = {
  /** The most pages. */
  pages: PAGES,
  /** The most surfels of a page. */
  pageSurfels: PAGE_SURFELS,
  /** Side of a chunk, metres. */
  chunkM: CHUNK_M,
  /** Side of a voxel, metres. */
  voxelM: VOXEL_M,
  /** Steps of a surfel's position along a chunk's side. */
  chunkSteps: CHUNK_STEPS,
  /** A unit of age, seconds. */
  ageUnitS: AGE_UNIT_S,
  /** What the clock of ages shows when the memory begins, seconds. */
  clockStartS: CLOCK_START_S,
} as const;

/** A place in a chunk, packed: x in bits 0–9, y in 10–19, z in 20–29, in steps. */
export function packPlace(x: number, y: number, z: number): number {
  return x | (y << 10) | (z << 20);
}

/** The voxel of a packed place: 15 bits. */
export function voxelOf(place: number): number {
  return ((place >>> 5) & 31) | (((place >>> 15) & 31) << 5) | (((place >>> 25) & 31) << 10);
}

/** The memory's clock, ticks. @param nowMs milliseconds since the memory began */
export function ticksOf(nowMs: number): number {
  return Math.max(Math.floor((nowMs / 1000 + CLOCK_START_S) * TICKS_PER_S), 0);
}

/** Ticks as units of age, 16 bits. */
export function ageUnits(ticks: number): number {
  return Math.min(Math.floor(ticks / (TICKS_PER_S * AGE_UNIT_S)), 0xffff);
}
