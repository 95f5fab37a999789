import type { Pose } from '@farpoint/protocol';
import { fromYaw } from './trigonometry.ts';

/** Position of a person or cart, and the distance it has walked, which determines its gait. */
export interface BodyPlace {
  x: number;
  y: number;
  cos: number;
  sin: number;
  walked: number;
}

/** Everything that a sensor needs to render the world. */
export interface WorldSnapshot {
  /** Simulated seconds since the start. */
  time: number;
  /** base_link on the floor, metres and radians. */
  x: number;
  y: number;
  yaw: number;
  /** In the order of the world's movers. */
  bodies: readonly BodyPlace[];
}

const BASE_NUMBERS = 4;
const BODY_NUMBERS = 5;

/** How many numbers a snapshot of a world with this many movers takes. */
export function snapshotNumbers(movers: number): number {
  return BASE_NUMBERS + movers * BODY_NUMBERS;
}

/** Writes the snapshot as plain numbers, for memory shared between threads. */
export function writeSnapshot(snapshot: WorldSnapshot, into: Float64Array): void {
  into[0] = snapshot.time;
  into[1] = snapshot.x;
  into[2] = snapshot.y;
  into[3] = snapshot.yaw;
  let at = BASE_NUMBERS;
  for (const { x, y, cos, sin, walked } of snapshot.bodies) {
    into[at] = x;
    into[at + 1] = y;
    into[at + 2] = cos;
    into[at + 3] = sin;
    into[at + 4] = walked;
    at += BODY_NUMBERS;
  }
}

/** @param from exactly what {@link writeSnapshot} wrote */
export function readSnapshot(from: Float64Array): WorldSnapshot {
  const bodies: BodyPlace[] = [];
  for (let at = BASE_NUMBERS; at + BODY_NUMBERS <= from.length; at += BODY_NUMBERS) {
    const [x, y, cos, sin, walked] = from.subarray(at, at + BODY_NUMBERS) as unknown as [
      number,
      number,
      number,
      number,
      number,
    ];
    bodies.push({ x, y, cos, sin, walked });
  }
  return { time: from[0]!, x: from[1]!, y: from[2]!, yaw: from[3]!, bodies };
}

/** Pose of base_link in the world. */
export function basePose({ x, y, yaw }: Pick<WorldSnapshot, 'x' | 'y' | 'yaw'>): Pose {
  return { position: { x, y, z: 0 }, orientation: fromYaw(yaw) };
}
