import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { EarthPlane, lengthText, MapProjection, roundLength } from './map-projection.ts';

const number = (most: number) => fc.double({ min: -most, max: most, noNaN: true });

function projection(up: 'x' | 'north'): MapProjection {
  const made = new MapProjection();
  Object.assign(made, { up, width: 400, height: 200 });
  return made;
}

describe('the map', () => {
  test('has x to the right and y up, or x up and y to the left', () => {
    const north = projection('north');
    const x = projection('x');
    expect(north.toScreen({ x: 1, y: 0 })).toEqual({ left: 250, top: 100 });
    expect(north.toScreen({ x: 0, y: 1 })).toEqual({ left: 200, top: 50 });
    expect(x.toScreen({ x: 1, y: 0 })).toEqual({ left: 200, top: 50 });
    expect(x.toScreen({ x: 0, y: 1 })).toEqual({ left: 150, top: 100 });
    expect(north.screenAngle(Math.PI / 2)).toBe(0);
    expect(x.screenAngle(0)).toBe(-0);
  });

  test('finds a place again, keeps it in place while zooming, and follows the finger', () => {
    fc.assert(
      fc.property(
        fc.constantFrom('x', 'north'),
        number(200),
        number(100),
        number(3),
        (up, left, top, log) => {
          const map = projection(up);
          const place = map.toPlace(left, top);
          map.zoom(10 ** log, { left, top });
          expect(map.toScreen(place).left).toBeCloseTo(left, 6);
          expect(map.toScreen(place).top).toBeCloseTo(top, 6);
          map.pan(30, -20);
          expect(map.toScreen(place).left).toBeCloseTo(left + 30, 6);
          expect(map.toScreen(place).top).toBeCloseTo(top - 20, 6);
        },
      ),
      { seed: 1, numRuns: 300 },
    );
  });

  test('cannot be zoomed beyond use', () => {
    const map = projection('north');
    for (let i = 0; i < 100; i++) map.zoom(10);
    expect(map.metresPerPixel).toBe(0.002);
    for (let i = 0; i < 100; i++) map.zoom(0.1);
    expect(map.metresPerPixel).toBe(2000);
  });

  test('has round lengths for its grid and its scale bar', () => {
    expect([0.7, 1, 4.9, 5, 99, 1200].map(roundLength)).toEqual([0.5, 1, 2, 5, 50, 1000]);
    expect([0.05, 1, 200, 5000].map(lengthText)).toEqual(['5 cm', '1 m', '200 m', '5 km']);
  });
});

describe('the plane around a place on the earth', () => {
  test('has metres, as the local radius has them', () => {
    const plane = new EarthPlane(48, 11);
    // A thousandth of a degree of latitude is 111.2 m on the sphere, everywhere.
    const north = plane.toPlace(48.001, 11);
    expect(north.x).toBeCloseTo(0, 6);
    expect(north.y).toBeCloseTo(111.32, 1);
    const east = plane.toPlace(48, 11.001);
    expect(east.x).toBeCloseTo(111.32 * Math.cos((48 * Math.PI) / 180), 1);
  });

  test('finds places on the world map again, up to its ends', () => {
    fc.assert(
      fc.property(number(90), number(180), number(1e5), number(1e5), (latitude, longitude, x, y) => {
        const plane = new EarthPlane(latitude, longitude);
        const place = plane.ofWorld(...plane.toWorld({ x, y }));
        expect(place.x).toBeCloseTo(x, 3);
        expect(place.y).toBeCloseTo(y, 3);
      }),
      { seed: 1, numRuns: 200 },
    );
  });
});
