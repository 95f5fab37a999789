/** The triangles of a tile, the same for all tiles: two for each cell between four neighbouring samples. */

/** Samples along a tile's side. */
export const TILE = 16;
/** Vertices along a tile's side: the last are the next tile's first. */
export const TILE_VERTICES = TILE + 1;
/** Which samples are drawn: every, every second or every fourth in a row and in a column. */
export const STRIDES = [1, 2, 4] as const;
/** Every how many samples of a row and of a column one is drawn. */
export type Stride = (typeof STRIDES)[number];

/**
 * Indices of a tile's triangles; vertex `y` · 17 + `x` is the sample in column `x` and row `y`. The last vertex of each
 * triangle, whose flat outputs the fragment shader gets, is its cell's upper left.
 */
export function tileIndices(stride: Stride): Uint16Array {
  const cells = TILE / stride;
  const indices = new Uint16Array(cells * cells * 6);
  let at = 0;
  for (let y = 0; y < TILE; y += stride) {
    for (let x = 0; x < TILE; x += stride) {
      const corner = y * TILE_VERTICES + x;
      const [right, below] = [corner + stride, corner + stride * TILE_VERTICES];
      const opposite = below + stride;
      indices.set([right, opposite, corner, opposite, below, corner], at);
      at += 6;
    }
  }
  return indices;
}

/** The stride at which about one of `every` samples is drawn. */
export function strideFor(every: number): Stride {
  return every >= 16 ? 4 : every >= 4 ? 2 : 1;
}
