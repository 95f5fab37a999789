import { expect, test } from 'vitest';
import { DEFAULT_EXTENT, ImageExtent } from './image-extent.ts';

/** One frame of a camera with the given tangents, packet by packet, in raster order. */
function frame(extent: ImageExtent, number: number, tanX: number, tanY: number, side = 60): void {
  const view = new DataView(new ArrayBuffer(150 * 6));
  let count = 0;
  for (let row = 0; row < side; row++) {
    for (let column = 0; column < side; column++) {
      const z = 1000 + ((row * 7 + column * 13) % 4000);
      view.setInt16(count * 6, (((column + 0.5) / side) * 2 - 1) * tanX * z, true);
      view.setInt16(count * 6 + 2, (((row + 0.5) / side) * 2 - 1) * tanY * z, true);
      view.setInt16(count * 6 + 4, z, true);
      if (++count < 150) continue;
      extent.add(number, view, 0, count);
      count = 0;
    }
  }
}

test('finds the field of view of narrow and wide cameras', () => {
  for (const [tanX, tanY] of [
    [1, 1],
    [0.2, 0.2],
    [1.2, 0.6],
  ] as const) {
    const extent = new ImageExtent();
    for (let number = 0; number < 20; number++) frame(extent, number, tanX, tanY);
    expect(extent.value).toBeCloseTo(2 * Math.sqrt(tanX * tanY), 1);
  }
});

test('learns nothing from a single packet or from points without depth', () => {
  const extent = new ImageExtent();
  const view = new DataView(new ArrayBuffer(6));
  for (let number = 0; number < 50; number++) extent.add(number, view, 0, 1);
  expect(extent.value).toBe(DEFAULT_EXTENT);
});
