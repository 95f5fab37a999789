import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { RING_COLOURS, ringColours } from './ring-colours.ts';
import { fillRingTable, nearestRing, RING_TEXELS, ringScale } from './ring-table.ts';

const ascending = fc
  .uniqueArray(fc.integer({ min: -900, max: 900 }), { minLength: 2, maxLength: 128 })
  .map((tenths) => tenths.sort((a, b) => a - b).map((tenth) => (tenth / 10 / 180) * Math.PI));

describe('the table of rings', () => {
  test('nearestRing is the nearest', () => {
    fc.assert(
      fc.property(ascending, fc.double({ min: -1.6, max: 1.6, noNaN: true }), (rings, elevation) => {
        const least = Math.min(...rings.map((ring) => Math.abs(ring - elevation)));
        expect(Math.abs(rings[nearestRing(rings, elevation)]! - elevation)).toBeCloseTo(least, 12);
      }),
    );
  });

  test('has each ring of a LiDAR with 128 of them in its colour, and its neighbours in others', () => {
    const rings = Array.from({ length: 128 }, (_, i) => ((-22.5 + (45 * i) / 127) / 180) * Math.PI);
    const table = new Uint8Array(RING_TEXELS * 4);
    fillRingTable(rings, table);
    const { from, texelsPerRadian } = ringScale(rings);
    for (const [i, ring] of rings.entries()) {
      const texel = Math.floor((ring - from) * texelsPerRadian);
      const wanted = ringColours()[i % RING_COLOURS]!.map((part) => Math.round(part * 255));
      // A fifth of a ring away, too.
      for (const near of [texel - 3, texel, texel + 3])
        expect([...table.subarray(near * 4, near * 4 + 4)]).toEqual([...wanted, 255]);
    }
  });

  test('reaches half a ring beyond the outermost', () => {
    const { from, texelsPerRadian } = ringScale([-0.1, 0, 0.1]);
    expect(from).toBeCloseTo(-0.15, 12);
    expect(from + RING_TEXELS / texelsPerRadian).toBeCloseTo(0.15, 12);
  });
});

describe('colours of rings', () => {
  const luma = ([red, green, blue]: readonly [number, number, number]) =>
    0.2126 * red ** 2.2 + 0.7152 * green ** 2.2 + 0.0722 * blue ** 2.2;

  test('are all different, and neighbours differ without hue, too', () => {
    const colours = ringColours();
    expect(colours).toHaveLength(RING_COLOURS);
    for (const [i, colour] of colours.entries()) {
      for (const part of colour) expect(part).toBeGreaterThanOrEqual(0);
      const next = colours[(i + 1) % RING_COLOURS]!;
      const [light, dark] = [luma(colour), luma(next)].sort((a, b) => b - a) as [number, number];
      expect((light + 0.05) / (dark + 0.05)).toBeGreaterThan(2);
      for (const other of colours.slice(i + 1))
        expect(Math.hypot(...colour.map((part, c) => part - other[c]!))).toBeGreaterThan(0.15);
    }
  });
});
