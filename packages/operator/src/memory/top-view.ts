/**
 * The remembered world from above, for a small map: of each cell the highest surfel below a ceiling. One buffer, which goes
 * to the worker and back.
 *
 *     0         1 byte for each cell, rows from the least y on: 0 for nothing, else its height in {@link TOP_VIEW.stepM},
 *               where 1 is {@link TOP_VIEW.lowestM} above the ground
 *   cells²      1 byte for each cell: how long ago it was seen, in units of age
 */
import {
  AGE_UNIT_S,
  CHUNK_M,
  CHUNK_STEPS,
  PAGE_SURFELS,
  STEPS_PER_METRE,
  TICKS_PER_S,
} from './memory-layout.ts';
import type { SurfelStore } from './surfel-store.ts';

/** How a {@link TopView} is divided. */
export const TOP_VIEW = {
  /** Cells along a side. */
  cells: 192,
  /** Side of a cell, metres. */
  cellM: 0.125,
  /** Heights of a cell: the lowest, metres above the ground, and the step. */
  lowestM: -1,
  /** A step of height, metres. */
  stepM: 0.0125,
  /** A unit of age, seconds. */
  ageUnitS: AGE_UNIT_S,
} as const;

const { cells: CELLS, cellM: CELL_M, lowestM: LOWEST_M, stepM: STEP_M } = TOP_VIEW;
const SIDE_M = CELLS * CELL_M;
/** Bytes of a view. */
export const TOP_VIEW_BYTES = 2 * CELLS * CELLS;
/** Heights are 1 to 255 steps: what is higher is left out, metres above the ground. */
const MOST_M = LOWEST_M + 254 * STEP_M;

/** What is to be seen from above: REP-103 world, metres. */
export interface TopViewArea {
  /** In the middle. */
  x: number;
  /** In the middle. */
  y: number;
  /** Height of the robot's ground. */
  ground: number;
  /** What is higher above the ground is left out. */
  ceiling: number;
}

/** The remembered world from above. */
export class TopView {
  /** The memory behind the arrays. */
  readonly buffer: ArrayBuffer;
  /** By cell, rows from the least y on: 0 for nothing, else {@link TOP_VIEW.lowestM} and steps of it from 1 on. */
  readonly heights: Uint8Array;
  /** By cell: when it was seen, units ago. */
  readonly ages: Uint8Array;
  /** Place of the first cell's outer corner, metres. */
  x = 0;
  /** Place of the first cell's outer corner, metres. */
  y = 0;
  /** None of it was seen longer ago than this, seconds; `null` if nothing is in view. */
  oldestS: number | null = null;

  /** @param buffer {@link TOP_VIEW_BYTES} long */
  constructor(buffer: ArrayBuffer) {
    this.buffer = buffer;
    this.heights = new Uint8Array(buffer, 0, CELLS * CELLS);
    this.ages = new Uint8Array(buffer, CELLS * CELLS);
  }

  /** Looks at a store. @param ticks now, on the memory's clock */
  fill(store: SurfelStore, { x, y, ground, ceiling }: Readonly<TopViewArea>, ticks: number): void {
    // On whole cells: a map that is drawn again and again stands still.
    this.x = Math.round((x - SIDE_M / 2) / CELL_M) * CELL_M;
    this.y = Math.round((y - SIDE_M / 2) / CELL_M) * CELL_M;
    this.heights.fill(0);
    const highest = ground + Math.min(ceiling, MOST_M);
    let oldest = Number.POSITIVE_INFINITY;
    for (let chunk = 0; chunk < store.pages; chunk++) {
      if ((store.chunkPages[chunk] as number) < 0) continue;
      const [left, bottom, low] = [
        (store.chunkX[chunk] as number) * CHUNK_M,
        (store.chunkY[chunk] as number) * CHUNK_M,
        (store.chunkZ[chunk] as number) * CHUNK_M,
      ];
      const isBeside = left + CHUNK_M <= this.x || left >= this.x + SIDE_M;
      if (isBeside || bottom + CHUNK_M <= this.y || bottom >= this.y + SIDE_M) continue;
      if (low + CHUNK_M <= ground + LOWEST_M || low >= highest) continue;
      oldest = Math.min(oldest, this.#addChunk(store, chunk, ground, highest, ticks));
    }
    this.oldestS = oldest === Number.POSITIVE_INFINITY ? null : (ticks - oldest) / TICKS_PER_S;
  }

  /** @returns when the oldest surfel was seen that came into a cell, ticks; Infinity if none did */
  #addChunk(store: SurfelStore, chunk: number, ground: number, highest: number, ticks: number): number {
    const toMetres = (corner: number, steps: number) => corner * CHUNK_M + (steps + 0.5) / STEPS_PER_METRE;
    const [cx, cy, cz] = [
      store.chunkX[chunk] as number,
      store.chunkY[chunk] as number,
      store.chunkZ[chunk] as number,
    ];
    const mask = CHUNK_STEPS - 1;
    let oldest = Number.POSITIVE_INFINITY;
    for (let page = store.chunkPages[chunk] as number; page >= 0; page = store.pageNext[page] as number) {
      const end = page * PAGE_SURFELS + (store.pageCounts[page] as number);
      for (let surfel = page * PAGE_SURFELS; surfel < end; surfel++) {
        if ((store.sightings[surfel] as number) < 2) continue;
        const place = store.places[surfel] as number;
        const z = toMetres(cz, place >>> 20);
        const step = Math.round((z - ground - LOWEST_M) / STEP_M) + 1;
        if (step < 1 || step > 255 || z > highest) continue;
        const column = Math.floor((toMetres(cx, place & mask) - this.x) / CELL_M);
        const row = Math.floor((toMetres(cy, (place >>> 10) & mask) - this.y) / CELL_M);
        if (column < 0 || row < 0 || column >= CELLS || row >= CELLS) continue;
        const cell = row * CELLS + column;
        if (step <= (this.heights[cell] as number)) continue;
        this.heights[cell] = step;
        const seen = Math.min(store.seen[surfel] as number, ticks);
        this.ages[cell] = Math.min(Math.floor((ticks - seen) / (TICKS_PER_S * AGE_UNIT_S)), 255);
        oldest = Math.min(oldest, seen);
      }
    }
    return oldest;
  }
}
