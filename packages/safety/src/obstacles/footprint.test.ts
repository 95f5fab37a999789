import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { Footprint, FootprintError } from './footprint.ts';

const BOX = [
  { x: 0.4, y: 0.3 },
  { x: -0.2, y: 0.3 },
  { x: -0.2, y: -0.3 },
  { x: 0.4, y: -0.3 },
];
const near = (footprint: Footprint, x: number, y: number) =>
  footprint.nearness(x, y, { distance: 0, x: 0, y: 0 });

describe('a footprint', () => {
  test('knows how far a point is from it, and where away from it is', () => {
    for (const corners of [BOX, [...BOX].reverse()]) {
      const box = new Footprint(corners);
      expect(near(box, 1, 0)).toEqual({ distance: 0.6, x: 1, y: 0 });
      expect(near(box, 0, 0).distance).toBeCloseTo(-0.2);
      expect(near(box, 0.7, 0.7).distance).toBeCloseTo(0.5);
      expect(near(box, 0.7, 0.7).x).toBeCloseTo(0.6);
      expect(box.reach).toBeCloseTo(0.5);
    }
  });

  test('of a disc lies around the disc', () => {
    const disc = Footprint.disc(0.25);
    for (let angle = 0; angle < 7; angle += 0.1) {
      const { distance } = near(disc, Math.cos(angle), Math.sin(angle));
      expect(distance).toBeLessThanOrEqual(0.75 + 1e-9);
      expect(distance).toBeGreaterThan(0.747);
    }
  });

  test('grows by a margin, in points that are near each other and face outwards', () => {
    const box = new Footprint(BOX);
    for (const margin of [0, 0.1, 0.5]) {
      const { points } = box.outline(margin, 0.05);
      for (let k = 0; k < points.length; k += 4) {
        const [x, y, nx, ny] = points.subarray(k, k + 4) as unknown as [number, number, number, number];
        const [nextX, nextY] = [points[(k + 4) % points.length]!, points[(k + 5) % points.length]!];
        expect(near(box, x, y).distance).toBeCloseTo(margin);
        expect(near(box, x + 0.01 * nx, y + 0.01 * ny).distance).toBeCloseTo(margin + 0.01);
        expect(Math.hypot(nextX - x, nextY - y)).toBeLessThanOrEqual(0.0501);
      }
    }
  });

  test.each([
    ['two corners', BOX.slice(0, 2)],
    ['a straight line', [0, 1, 2].map((x) => ({ x, y: 0 }))],
    ['a dent', [...BOX, { x: 0.1, y: 0.1 }]],
    ['base_link outside', BOX.map(({ x, y }) => ({ x: x + 1, y }))],
    ['NaN', [{ x: Number.NaN, y: 0 }, ...BOX]],
    ['a corner too far away', BOX.map(({ x, y }) => ({ x: x * 100, y }))],
  ])('is refused with %s', (_, corners) => {
    expect(() => new Footprint(corners)).toThrow(FootprintError);
  });

  test('is either refused or works, whatever the corners', () => {
    const corner = fc.record({
      x: fc.double({ min: -1, max: 1, noNaN: true }),
      y: fc.double({ min: -1, max: 1 }),
    });
    fc.assert(
      fc.property(fc.array(corner, { maxLength: 6 }), (corners) => {
        let footprint: Footprint;
        try {
          footprint = new Footprint(corners);
        } catch (error) {
          expect(error).toBeInstanceOf(FootprintError);
          return;
        }
        expect(near(footprint, 0, 0).distance).toBeLessThanOrEqual(0);
        expect(footprint.outline(0.1, 0.05).points.every(Number.isFinite)).toBe(true);
      }),
      { seed: 5 },
    );
  });
});
