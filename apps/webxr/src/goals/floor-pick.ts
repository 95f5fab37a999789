/** Where on the floor a place of the screen is. */
import { type Camera, type Object3D, Raycaster, Vector2, Vector3 } from 'three';

/** A place on the floor in the robot's world (REP-103), m. */
export interface FloorPlace {
  x: number;
  y: number;
}

/** What shows the world, as of the last display frame. */
export interface Shown {
  readonly camera: Camera;
  /** Carries the robot's world, in its axes. */
  readonly world: Object3D;
}

const caster = new Raycaster();
const [from, to] = [new Vector3(), new Vector3()];

/**
 * @param right across the screen, −1 to 1, and `up`
 * @param ground height of the floor in the robot's world, m
 * @returns `null` where no floor is: at the horizon and above it
 */
export function floorUnder(
  { camera, world }: Shown,
  right: number,
  up: number,
  ground: number,
): FloorPlace | null {
  caster.setFromCamera(new Vector2(right, up), camera);
  const hit = floorAlong(caster.ray.origin, caster.ray.direction, world, ground);
  return hit === null ? null : { x: hit.x, y: hit.y };
}

/**
 * @param origin of a line in the scene, and `direction`, its unit vector
 * @returns where it meets the floor, and how far that is in the scene's metres; `null` if it does not
 */
export function floorAlong(
  origin: Vector3,
  direction: Vector3,
  world: Object3D,
  ground: number,
): (FloorPlace & { metres: number }) | null {
  world.worldToLocal(from.copy(origin));
  world.worldToLocal(to.copy(origin).add(direction));
  const falls = to.z - from.z;
  const metres = (ground - from.z) / falls;
  // Written so that a level line is none.
  if (!(metres > 0 && Number.isFinite(metres))) return null;
  return { x: from.x + (to.x - from.x) * metres, y: from.y + (to.y - from.y) * metres, metres };
}

/** Where a place on the floor is on the screen: −1 to 1 to the right, and up; `null` if it is behind the operator. */
export function onScreen(
  { camera, world }: Shown,
  { x, y }: FloorPlace,
  ground: number,
): { right: number; up: number } | null {
  const place = world.localToWorld(from.set(x, y, ground));
  to.copy(place).applyMatrix4(camera.matrixWorldInverse);
  if (to.z >= 0) return null;
  place.project(camera);
  return { right: place.x, up: place.y };
}
