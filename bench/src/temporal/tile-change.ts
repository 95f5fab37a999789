/** Which tiles of a depth camera's picture show something else than before. */

/** Side of a tile, pixels: the organised codec's. */
export const TILE = 16;
/** Differences within so many standard deviations are noise. */
const SIGMAS = 4;
const COLOUR_LEVELS = 12;
/** More pixels than this share must show something else, or have become known or unknown: at edges some do in every frame. */
const LEAST_OTHER = 0.05;
const LEAST_FLIPPED = 0.25;

export interface TileChange {
  width: number;
  height: number;
  /** Standard deviation of depth at 1 m, metres; it grows with the square of depth. */
  noisePerZ2: number;
}

interface Images {
  /** Metres, 0 where unknown. */
  depth: Float32Array;
  /** R, G, B from the lowest byte. */
  colour: Uint32Array;
}

/** @returns 1 for each tile that has changed, row by row */
export function changedTiles(
  { width, height, noisePerZ2 }: TileChange,
  before: Images,
  now: Images,
): Uint8Array {
  const columns = Math.ceil(width / TILE);
  const changed = new Uint8Array(columns * Math.ceil(height / TILE));
  const limit = SIGMAS * Math.SQRT2 * noisePerZ2;
  for (let tile = 0; tile < changed.length; tile++) {
    const [x, y] = [(tile % columns) * TILE, Math.floor(tile / columns) * TILE];
    let [pixels, other, flipped] = [0, 0, 0];
    for (let row = y; row < Math.min(y + TILE, height); row++) {
      for (let column = x; column < Math.min(x + TILE, width); column++) {
        const i = row * width + column;
        pixels++;
        const [z0, z1] = [before.depth[i] as number, now.depth[i] as number];
        const known = z0 > 0;
        if (known !== z1 > 0) flipped++;
        else if (
          known &&
          (Math.abs(z1 - z0) > limit * Math.max(z0, z1) ** 2 || coloursDiffer(before, now, i))
        )
          other++;
      }
    }
    if (other > pixels * LEAST_OTHER || flipped > pixels * LEAST_FLIPPED) changed[tile] = 1;
  }
  return changed;
}

function coloursDiffer(before: Images, now: Images, pixel: number): boolean {
  const [a, b] = [before.colour[pixel] as number, now.colour[pixel] as number];
  for (let shift = 0; shift < 24; shift += 8) {
    if (Math.abs(((a >> shift) & 255) - ((b >> shift) & 255)) > COLOUR_LEVELS) return true;
  }
  return false;
}
