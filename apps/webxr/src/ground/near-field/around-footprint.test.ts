import fc from 'fast-check';
import { expect, test } from 'vitest';
import { distanceFrom, innerRadius, radiusAt, reachOf } from './around-footprint.ts';

const LONG = [
  { x: 0.6, y: 0.2 },
  { x: -0.2, y: 0.2 },
  { x: -0.2, y: -0.2 },
  { x: 0.6, y: -0.2 },
];

test('a distance counts from the outline', () => {
  expect(distanceFrom(LONG, 0.1, 0.1)).toBe(0);
  expect(distanceFrom(LONG, 0.9, 0)).toBeCloseTo(0.3);
  expect(distanceFrom(LONG, 0, -0.5)).toBeCloseTo(0.3);
  expect(distanceFrom(LONG, 0.9, 0.6)).toBeCloseTo(0.5);
});

test('the nearest side', () => expect(innerRadius(LONG)).toBeCloseTo(0.2));

test('a point at a bearing and a distance from the outline is that far from it', () => {
  const bearings = fc.double({ min: -4, max: 4, noNaN: true });
  const distances = fc.double({ min: 0, max: 4, noNaN: true });
  fc.assert(
    fc.property(bearings, distances, (bearing, metres) => {
      const radius = radiusAt(LONG, bearing, metres);
      const away = distanceFrom(LONG, radius * Math.cos(bearing), radius * Math.sin(bearing));
      expect(away).toBeCloseTo(metres, 6);
    }),
    { seed: 1, numRuns: 200 },
  );
});

test('a corner and a side are met exactly', () => {
  expect(radiusAt(LONG, Math.atan2(0.2, 0.6), 0)).toBeCloseTo(Math.hypot(0.6, 0.2), 9);
  expect(radiusAt(LONG, 0, 0.5)).toBeCloseTo(1.1, 9);
  expect(radiusAt(LONG, Math.PI, 0)).toBeCloseTo(0.2, 9);
  expect(reachOf(LONG)).toBeCloseTo(Math.hypot(0.6, 0.2), 9);
});
