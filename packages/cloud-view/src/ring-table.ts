/** The colour of the ring at each elevation, as a table that the shader looks elevations up in. */
import { RING_COLOURS, ringColours } from './ring-colours.ts';

/** Entries of the table, from half a ring below the lowest ring to half a ring above the highest. */
export const RING_TEXELS = 2048;

/** Where the table's elevations lie: entry i begins at `from + i / texelsPerRadian`. */
export interface RingScale {
  readonly from: number;
  readonly texelsPerRadian: number;
}

/** @param elevations ascending, at least two */
export function ringScale(elevations: readonly number[]): RingScale {
  const lowest = elevations[0] as number;
  const highest = elevations.at(-1) as number;
  const halfRing = (highest - lowest) / (elevations.length - 1) / 2;
  return { from: lowest - halfRing, texelsPerRadian: RING_TEXELS / (highest - lowest + 2 * halfRing) };
}

/** The ring whose elevation is nearest. @param elevations ascending */
export function nearestRing(elevations: readonly number[], elevation: number): number {
  let low = 0;
  let high = elevations.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if ((elevations[middle] as number) <= elevation) low = middle;
    else high = middle;
  }
  return elevation - (elevations[low] as number) <= (elevations[high] as number) - elevation ? low : high;
}

/** Fills the table. @param into R, G, B, A of each entry */
export function fillRingTable(elevations: readonly number[], into: Uint8Array): void {
  const { from, texelsPerRadian } = ringScale(elevations);
  const colours = ringColours();
  for (let i = 0; i < RING_TEXELS; i++) {
    const ring = nearestRing(elevations, from + (i + 0.5) / texelsPerRadian);
    const [red, green, blue] = colours[ring % RING_COLOURS]!;
    into.set([red * 255, green * 255, blue * 255, 255].map(Math.round), i * 4);
  }
}
