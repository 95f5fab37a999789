import { expect, test } from 'vitest';
import { STRIDES, strideFor, TILE, TILE_VERTICES, tileIndices } from './tile-geometry.ts';

test.each(STRIDES)(
  'with stride %i the triangles cover a tile once, and end in their cell’s corner',
  (stride) => {
    const indices = tileIndices(stride);
    let area = 0;
    for (let i = 0; i < indices.length; i += 3) {
      const [a, b, c] = [0, 1, 2].map((k) => {
        const vertex = indices[i + k] as number;
        return { x: vertex % TILE_VERTICES, y: Math.floor(vertex / TILE_VERTICES) };
      }) as [{ x: number; y: number }, { x: number; y: number }, { x: number; y: number }];
      const twice = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
      // All turn the same way, so none lies over another.
      expect(twice).toBe(stride * stride);
      area += twice / 2;
      expect([c.x, c.y]).toEqual([Math.min(a.x, b.x, c.x), Math.min(a.y, b.y, c.y)]);
    }
    expect(area).toBe(TILE * TILE);
  },
);

test('the stride is chosen so that no more is drawn than asked for, where that can be', () => {
  expect([1, 2, 4, 8, 16].map(strideFor)).toEqual([1, 1, 2, 2, 4]);
});
