/**
 * A recorded cloud as a room in which a simulated robot drives: its floor is found, and what the robot's camera would see of
 * it from elsewhere is drawn from its points. What the recording did not see is not there, neither for the camera nor for
 * the count of contacts.
 */
import { type Pose, rotationMatrix } from '@farpoint/protocol';
import { DEFAULT_LIMITS, SimulatedBase, type WorldDescription } from '@farpoint/sim';
import type { Codec } from '@farpoint/wasm-codec';
import { opticalMount } from '../sense/sources/sensor-mount.ts';
import { findFloor } from './floor-plane.ts';
import { type GuardedRun, type GuardTimes, guardedDrive, type StageCamera, seeded } from './guarded-drive.ts';
import { PointCamera } from './point-camera.ts';

/** A camera's points, x y z and a word, in its optical frame: metres, NaN where there is none. */
export interface RecordedCloud {
  name: string;
  points: Float32Array;
  /** Focal length of the camera that took it, and its width, pixels. */
  focal: number;
  width: number;
}

/**
 * What is higher than the first is a reason to stop, as the guard is told; touching what is higher than the second is a
 * contact: cameras are wrong by some centimetres. Higher than the third, it is passed under, metres.
 */
const LOW_M = 0.04;
const CONTACT_M = 0.08;
const HIGH_M = 1.1;
/** Points within a cell of this size, and how many of them are something that stands there. */
const CELL_M = 0.05;
const LEAST_POINTS = 4;
/** One point in each cube of this size is drawn. */
const CUBE_M = 0.01;
const CUBES = 65_536;
/** The camera sits as far ahead of base_link as the simulated robot's. */
const FORWARD_M = 0.12;
const SIZE = 160;
/** How far around where it was recorded the robot starts. */
const [AHEAD_M, ASIDE_M, TURNED] = [0.5, 0.4, 0.5];
const ROOM_M = 0.3;

export class RecordedRoom {
  readonly name: string;
  readonly mount: Pose;
  /** Height of the camera above the floor, metres. */
  readonly heightM: number;
  /** x, y, z in the world, whose origin is base_link where it was recorded. */
  readonly #points: Float32Array;
  /** x, y of what stands on the floor, and of what of it is a contact. */
  readonly #things: Float64Array;
  readonly #solid: Float64Array;
  readonly #focal: number;

  private constructor(name: string, mount: Pose, points: Float32Array, focal: number) {
    this.name = name;
    this.mount = mount;
    this.heightM = mount.position.z;
    this.#points = points;
    this.#things = thingsOf(points, LOW_M);
    this.#solid = thingsOf(points, CONTACT_M);
    this.#focal = focal;
  }

  /** @returns `null` if it has no floor on which a robot could have stood */
  static of({ name, points, focal, width }: RecordedCloud): RecordedRoom | null {
    const floor = findFloor(points);
    if (floor === null) return null;
    const { up, height } = floor;
    const mount = opticalMount({
      ...{ x: FORWARD_M, y: 0, z: height, yaw: 0 },
      ...{ roll: Math.atan2(-up[0], -up[1]), pitch: Math.asin(-up[2]) },
    });
    return new RecordedRoom(name, mount, placed(points, mount), (focal * SIZE) / width);
  }

  /** How many places something stands in. */
  get things(): number {
    return this.#things.length / 2;
  }

  /** From the edge of a robot that stands there to the nearest thing, metres; negative inside one. */
  clearanceAt(x: number, y: number): number {
    return nearest(this.#things, x, y) - DEFAULT_LIMITS.radius;
  }

  /** Whether a robot that stands there touches something. */
  isTouched(x: number, y: number): boolean {
    return nearest(this.#solid, x, y) < DEFAULT_LIMITS.radius;
  }

  /** A base in it, somewhere near where it was recorded, that looks about where the camera looked. */
  start(random: () => number): SimulatedBase {
    for (let tries = 0; tries < 1000; tries++) {
      const [x, y] = [(random() * 2 - 1) * AHEAD_M, (random() * 2 - 1) * ASIDE_M];
      const yaw = (random() * 2 - 1) * TURNED;
      if (this.clearanceAt(x, y) < ROOM_M) continue;
      return new SimulatedBase({ ...EMPTY, start: { x, y, yaw } });
    }
    throw new Error(`${this.name}: no room for a robot`);
  }

  /** What the camera of a robot there sees of it. */
  cameraOn(base: SimulatedBase): StageCamera {
    return new PointCamera(this.#points, this.mount, { size: SIZE, focal: this.#focal, cubeM: CUBE_M }, base);
  }
}

/** A world in which nothing stands. */
export const EMPTY: WorldDescription = {
  ...{ name: 'recorded', start: { x: 0, y: 0, yaw: 0 }, lampSpacing: 3, materials: {} },
  ...{ boxes: [], panels: [], ellipsoids: [], movers: [] },
};

/** One run towards what stands there. The same room and seed give the same run. */
export function roomRun(
  codec: Codec,
  room: RecordedRoom,
  seed: number,
  seconds = 8,
  times: GuardTimes | null = null,
): GuardedRun {
  const random = seeded(seed);
  const base = room.start(random);
  const speed = 0.2 + 0.8 * random();
  return guardedDrive(
    codec,
    {
      ...{ name: room.name, base, radius: DEFAULT_LIMITS.radius },
      ...{ cameras: [room.cameraOn(base)], close: () => undefined },
      clearanceAt: (x, y) => room.clearanceAt(x, y),
      edgeAt: () => Number.POSITIVE_INFINITY,
      isStill: () => true,
      touched: () => {
        const { x, y } = base.state.pose.position;
        return room.isTouched(x, y);
      },
    },
    { seed, random, speed, seconds, times },
  );
}

/** The distance of the nearest of these places. */
function nearest(places: Float64Array, x: number, y: number): number {
  let squared = Number.POSITIVE_INFINITY;
  for (let i = 0; i < places.length; i += 2) {
    const [dx, dy] = [(places[i] as number) - x, (places[i + 1] as number) - y];
    squared = Math.min(squared, dx * dx + dy * dy);
  }
  return Math.sqrt(squared);
}

/** The points in the world, one of each cube. */
function placed(points: Float32Array, mount: Pose): Float32Array {
  const kept: number[] = [];
  const cubes = new Set<number>();
  const toWorld = transformOf(mount);
  const world = new Float64Array(3);
  for (let i = 0; i < points.length; i += 4) {
    const [x, y, z] = [points[i] as number, points[i + 1] as number, points[i + 2] as number];
    if (!(z > 0 && Number.isFinite(x + y + z))) continue;
    toWorld(x, y, z, world, 0);
    const [atX, atY, atZ] = world as unknown as [number, number, number];
    const cube = (cubeOf(atX) * CUBES + cubeOf(atY)) * CUBES + cubeOf(atZ);
    if (cubes.has(cube)) continue;
    cubes.add(cube);
    kept.push(atX, atY, atZ);
  }
  return Float32Array.from(kept);
}

/** From 0, along an axis on which no recording reaches farther than half of all of them from where it was made. */
function cubeOf(metres: number): number {
  return Math.floor(metres / CUBE_M) + CUBES / 2;
}

/** Writes where points of one frame are in another, whose pose they are given in, without making an object for each. */
export function transformOf({ position, orientation }: Pose) {
  const [r0, r1, r2, r3, r4, r5, r6, r7, r8] = rotationMatrix(orientation);
  return (x: number, y: number, z: number, into: Float32Array | Float64Array, at: number): void => {
    into[at] = r0 * x + r1 * y + r2 * z + position.x;
    into[at + 1] = r3 * x + r4 * y + r5 * z + position.y;
    into[at + 2] = r6 * x + r7 * y + r8 * z + position.z;
  };
}

/** Where something stands: points that the robot would hit, in cells that have several. */
function thingsOf(points: Float32Array, low: number): Float64Array {
  const cells = new Map<string, number[]>();
  for (let i = 0; i < points.length; i += 3) {
    const [x, y, z] = [points[i] as number, points[i + 1] as number, points[i + 2] as number];
    if (z < low || z > HIGH_M) continue;
    const cell = `${Math.floor(x / CELL_M)},${Math.floor(y / CELL_M)}`;
    const there = cells.get(cell);
    if (there === undefined) cells.set(cell, [x, y]);
    else there.push(x, y);
  }
  const enough = [...cells.values()].filter((there) => there.length >= 2 * LEAST_POINTS);
  // Within a cell, points one on top of the other say the same.
  return Float64Array.from(enough.flatMap((there) => thinned(there)));
}

function thinned(places: readonly number[]): number[] {
  const kept = new Map<string, readonly [number, number]>();
  for (let i = 0; i < places.length; i += 2) {
    const [x, y] = [places[i] as number, places[i + 1] as number];
    kept.set(`${Math.floor(x / CUBE_M)},${Math.floor(y / CUBE_M)}`, [x, y]);
  }
  return [...kept.values()].flat();
}
