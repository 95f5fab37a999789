/** Where on the floor a ray ends. Pure but for three.js' vectors. */
import type { Spot } from '@farpoint/protocol';
import type { Ray } from 'three';

/** Farther, a pixel of the screen is metres of the floor. Chosen by eye. floor-spot.test.ts holds it. */
export const FARTHEST_SPOT_M = 50;

/**
 * @param ray in the robot's world (REP-103), metres, with a direction of length 1
 * @param floorM the floor's height in that world
 * @param scale how much farther it may end: where the world is a model, metres of it in a metre of the room
 * @returns `null` if the ray does not end on the floor, or too far away
 */
export function floorSpot({ origin, direction }: Ray, floorM: number, scale = 1): Spot | null {
  const distance = (floorM - origin.z) / direction.z;
  if (!(distance > 0 && distance <= FARTHEST_SPOT_M * scale)) return null;
  return { x: origin.x + direction.x * distance, y: origin.y + direction.y * distance, z: floorM };
}
