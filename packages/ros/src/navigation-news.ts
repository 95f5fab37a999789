/** What a navigator's topic says, in the robot's world: a path or a map that can be told to operators, or why not. */
import { bodyYaw, compose, type Pose, type Vector3 } from '@farpoint/protocol';

/** Why a path or a map cannot be shown. */
export const navigationRefusals = [
  'unknown-frame', // it is not known where its frame is in the world, or where the robot is
  'not-level', // its plane is not the floor's
  'out-of-range', // it is too far away, or has coordinates that are no numbers
] as const;
export type NavigationRefusal = (typeof navigationRefusals)[number];

/** A map with bounded size. */
export interface OccupancyMap {
  /** Cells along x and y. */
  width: number;
  height: number;
  /** Side of a cell, metres. */
  cellM: number;
  /** Pose in the world of the first cell's outer corner: metres, radians. */
  origin: { x: number; y: number; yaw: number };
  /** States by their number in the protocol, row by row. */
  cells: Uint8Array;
}

export type NavigationNews =
  /** @param points in the world, metres; empty if there is no path */
  | { kind: 'path'; points: [x: number, y: number][] }
  | { kind: 'map'; map: OccupancyMap }
  /** @param frame of the message */
  | { kind: 'refused'; of: 'path' | 'map'; reason: NavigationRefusal; frame: string };

/** Cosine of the steepest floor: 10°. */
const LEAST_UPRIGHT = 0.985;

/** A pose on the floor. @returns `null` if its z axis does not point up */
export function onFloor({ position, orientation }: Pose): { x: number; y: number; yaw: number } | null {
  const { x, y } = orientation;
  if (!(1 - 2 * (x * x + y * y) >= LEAST_UPRIGHT)) return null;
  return { x: position.x, y: position.y, yaw: bodyYaw(orientation) };
}

/** A place in a frame, in the world. */
export function inWorld(frame: Pose, place: Vector3): Vector3 {
  return compose(frame, { position: place, orientation: { x: 0, y: 0, z: 0, w: 1 } }).position;
}
