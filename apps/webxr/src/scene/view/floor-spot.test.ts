import { Ray, Vector3 } from 'three';
import { expect, test } from 'vitest';
import { FARTHEST_SPOT_M, floorSpot } from './floor-spot.ts';

const ray = (z: number, down: number) => new Ray(new Vector3(1, 2, z), new Vector3(1, 0, -down).normalize());

test('ends where the ray meets the floor', () => {
  const spot = floorSpot(ray(1, 1), 0);
  expect(spot?.x).toBeCloseTo(2, 9);
  expect(spot).toMatchObject({ y: 2, z: 0 });
  expect(floorSpot(ray(3, 1), 1)).toMatchObject({ z: 1 });
});

test('does not end on the floor above the horizon, along it, behind, or too far away', () => {
  expect(floorSpot(ray(1, -1), 0)).toBeNull();
  expect(floorSpot(ray(1, 0), 0)).toBeNull();
  expect(floorSpot(ray(-1, 1), 0)).toBeNull();
  const steep = (metres: number, scale = 1) =>
    floorSpot(new Ray(new Vector3(0, 0, metres), new Vector3(0, 0, -1)), 0, scale);
  expect(steep(FARTHEST_SPOT_M)).toEqual({ x: 0, y: 0, z: 0 });
  expect(steep(FARTHEST_SPOT_M + 0.01)).toBeNull();
  // In a model of the world, as far in the room.
  expect(steep(FARTHEST_SPOT_M * 20, 20)).toEqual({ x: 0, y: 0, z: 0 });
  expect(steep(FARTHEST_SPOT_M * 20 + 0.1, 20)).toBeNull();
});
