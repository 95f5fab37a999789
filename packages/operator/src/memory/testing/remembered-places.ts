/** What a memory remembers, for tests. */
import { CHUNK_M, CHUNK_STEPS, PAGE_SURFELS } from '../memory-layout.ts';
import type { SurfelStore } from '../surfel-store.ts';

export interface RememberedPlace {
  x: number;
  y: number;
  z: number;
  colour: number;
}

/** All that is confirmed, metres. */
export function rememberedPlaces(store: SurfelStore): RememberedPlace[] {
  const places: RememberedPlace[] = [];
  for (let page = 0; page < store.pages; page++) {
    const chunk = store.pageChunks[page] as number;
    if (chunk < 0) continue;
    for (let i = 0; i < (store.pageCounts[page] as number); i++) {
      const surfel = page * PAGE_SURFELS + i;
      if ((store.sightings[surfel] as number) < 2) continue;
      const place = store.places[surfel] as number;
      const metres = (corner: number | undefined, steps: number) =>
        ((corner as number) + (steps + 0.5) / CHUNK_STEPS) * CHUNK_M;
      places.push({
        x: metres(store.chunkX[chunk], place & 1023),
        y: metres(store.chunkY[chunk], (place >>> 10) & 1023),
        z: metres(store.chunkZ[chunk], place >>> 20),
        colour: store.colours[surfel] as number,
      });
    }
  }
  return places;
}
