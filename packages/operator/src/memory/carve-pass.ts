/**
 * Removes what is no longer there: surfels that the robot sees through, that lie behind a surface which is now measured from
 * nearby, and that nobody confirmed. Goes through the chunks in turn, so that a call's work is bounded.
 */
import { CHUNK_M, CHUNK_STEPS, PAGE_SURFELS, TICKS_PER_S } from './memory-layout.ts';
import type { SensorView } from './sensor-view.ts';
import type { SurfelStore } from './surfel-store.ts';

/** Surfels that a call looks at, at the most (and the rest of a chunk). */
const BUDGET = 60_000;
/** What is seen through is nearer than what is seen by this, and by what grows with the square of the range, metres. */
const LEAST_GAP_M = 0.1;
const GAP_PER_M2 = 0.005;
/**
 * Sightings that being seen through once takes back. Chosen: what was confirmed goes after three frames,
 * within a second (docs/memory.md); world-map.test.ts holds it.
 */
const LOST_SIGHTINGS = 3;
/** What was not confirmed is forgotten after this time, ticks. */
const UNCONFIRMED_TICKS = 10 * TICKS_PER_S;
/** Standard deviation of places along the line of sight, metres at a distance of 1 m; grows with the square. */
const NOISE_PER_M2 = 0.002;
/**
 * What is measured from less than this share of an earlier distance is better: it replaces the place, and behind it, what
 * is left of the earlier noise goes. Chosen: the error grows with the square of the distance, so it has halved.
 */
export const BETTER = 0.7;

export class CarvePass {
  readonly #store: SurfelStore;
  /** The chunk at which the next call goes on. */
  #next = 0;

  constructor(store: SurfelStore) {
    this.#store = store;
  }

  /** @param ticks when the view was captured @returns the number of surfels removed */
  run(view: SensorView, ticks: number): number {
    const store = this.#store;
    let looked = 0;
    let removed = 0;
    for (let done = 0; done < store.pages && looked < BUDGET; done++) {
      const chunk = this.#next;
      this.#next = (chunk + 1) % store.pages;
      if ((store.chunkPages[chunk] as number) < 0) continue;
      const x = ((store.chunkX[chunk] as number) + 0.5) * CHUNK_M;
      const y = ((store.chunkY[chunk] as number) + 0.5) * CHUNK_M;
      const z = ((store.chunkZ[chunk] as number) + 0.5) * CHUNK_M;
      const inView = view.mayShow(x, y, z);
      // Elsewhere nothing can be seen through; what is unconfirmed there was seen last with the chunk.
      if (!inView && ticks - (store.chunkSeen[chunk] as number) > 2 * UNCONFIRMED_TICKS) continue;
      const before = store.count;
      looked += this.#carve(chunk, view, ticks, inView);
      removed += before - store.count;
    }
    return removed;
  }

  /** @returns the number of surfels looked at */
  #carve(chunk: number, view: SensorView, ticks: number, inView: boolean): number {
    const store = this.#store;
    const { position, rotation: r, picture } = view;
    // Of the chunk's corner, from the sensor.
    const ox = (store.chunkX[chunk] as number) * CHUNK_M - (position[0] as number);
    const oy = (store.chunkY[chunk] as number) * CHUNK_M - (position[1] as number);
    const oz = (store.chunkZ[chunk] as number) * CHUNK_M - (position[2] as number);
    const step = CHUNK_M / CHUNK_STEPS;
    let looked = 0;
    for (let page = store.chunkPages[chunk] as number; page >= 0; ) {
      const next = store.pageNext[page] as number;
      const from = page * PAGE_SURFELS;
      for (let surfel = from + (store.pageCounts[page] as number) - 1; surfel >= from; surfel--) {
        looked++;
        const sightings = store.sightings[surfel] as number;
        const age = ticks - (store.seen[surfel] as number);
        if (sightings <= 1 && age > UNCONFIRMED_TICKS) {
          store.remove(surfel);
          continue;
        }
        if (!inView || age === 0) continue;
        const place = store.places[surfel] as number;
        const wx = ox + ((place & 1023) + 0.5) * step;
        const wy = oy + (((place >>> 10) & 1023) + 0.5) * step;
        const wz = oz + ((place >>> 20) + 0.5) * step;
        const x = (r[0] as number) * wx + (r[3] as number) * wy + (r[6] as number) * wz;
        const y = (r[1] as number) * wx + (r[4] as number) * wy + (r[7] as number) * wz;
        const z = (r[2] as number) * wx + (r[5] as number) * wy + (r[8] as number) * wz;
        const range = Math.sqrt(x * x + y * y + z * z);
        const seen = picture.nearestAround(x, y, z);
        if (seen === 0) continue;
        if (range < seen - LEAST_GAP_M - GAP_PER_M2 * seen * seen) {
          if (sightings <= LOST_SIGHTINGS) store.remove(surfel);
          else store.sightings[surfel] = sightings - LOST_SIGHTINGS;
        } else if (isRemnant(range, picture.at(x, y, z), (store.distances[surfel] as number) * 0.05))
          store.remove(surfel);
      }
      page = next;
    }
    return looked;
  }
}

/** Whether a surfel is what an earlier, less certain measurement left behind a surface. All in metres. */
function isRemnant(range: number, seen: number, measuredFrom: number): boolean {
  const behind = range - seen;
  return (
    seen > 0 && behind > 0.05 && seen < BETTER * measuredFrom && behind < 3 * NOISE_PER_M2 * measuredFrom ** 2
  );
}
