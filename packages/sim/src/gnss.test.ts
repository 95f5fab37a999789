import { expect, test } from 'vitest';
import { earthPlace } from './gnss.ts';

test('a degree of latitude and of longitude is as long as on the ellipsoid', () => {
  const origin = { latitude: 48, longitude: 11 };
  // From the tables of WGS 84: 111.1998 km and 74.6280 km at 48°.
  expect(earthPlace(origin, 0, 111.2).latitude - 48).toBeCloseTo(0.001, 6);
  expect(earthPlace(origin, 74.628, 0).longitude - 11).toBeCloseTo(0.001, 6);
  expect(earthPlace({ latitude: 0, longitude: 0 }, 111.32, 0).longitude).toBeCloseTo(0.001, 6);
});
