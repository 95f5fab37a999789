/** A robot that drives among furniture and walking people and remembers what it sees; and how well it remembers. */

import { depthKeyFrame } from '@farpoint/operator/testing/depth-key-frame';
import {
  CHUNK_M,
  CHUNK_STEPS,
  KEY_FRAME_BYTES,
  KeyFrame,
  PAGE_SURFELS,
  WorldMap,
} from '@farpoint/operator/world-map';
import { type CameraIntrinsics, compose, type Pose } from '@farpoint/protocol';
import { type CloudFrame, officeWorld, SimulatedBase, SimulatedCamera } from '@farpoint/sim';
import { TrueSurfaces } from './true-surfaces.ts';

export interface DriveFigures {
  /** Share of the true surface seen from within 5.5 m that has something remembered within 0.1 m, 0–1. */
  remembered: number;
  /** Distances of what is remembered from the true surfaces, metres. */
  distancesM: number[];
  /** Share of what is remembered that is farther from any true surface than 0.25 m, 0–1. */
  ghosts: number;
  /** What is remembered. */
  surfels: number;
  /** Bytes that the memory takes, and those that its surfels need. */
  bytes: number;
  /** Work of each key frame, ms. */
  workMs: number[];
}

/** As in `pnpm bench view`: the robot drives curves, and looks around. */
const SPEED = 0.5;
const TURN = 0.7;
const TURN_PERIOD_S = 9;
const KEY_FRAMES_PER_S = 4;
/** One of so many rows and columns of pixels is remembered, as in the page; and looked at for the truth. */
const STRIDE = 2;
const TRUTH_STRIDE = 12;
const TRUTH_RANGE_M = 5.5;
const NEAR_M = 0.1;
const GHOST_M = 0.25;

export async function rememberedDrive(seconds: number, seed: number): Promise<DriveFigures> {
  const world = officeWorld();
  const base = new SimulatedBase(world);
  const camera = await SimulatedCamera.create({ world, seed });
  // What stays: nobody should remember people.
  const truth = await SimulatedCamera.create({ world: { ...world, movers: [] }, seed });
  const map = new WorldMap();
  const frame = new KeyFrame(new ArrayBuffer(KEY_FRAME_BYTES));
  const seen: number[] = [];
  const workMs: number[] = [];
  for (let i = 0; i < seconds * KEY_FRAMES_PER_S; i++) {
    const time = i / KEY_FRAMES_PER_S;
    const turn = TURN * Math.sin((2 * Math.PI * time) / TURN_PERIOD_S);
    base.setCommand({ linear: { x: SPEED, y: 0, z: 0 }, angular: { x: 0, y: 0, z: turn } });
    base.step(1 / KEY_FRAMES_PER_S);
    depthKeyFrame(camera.render(base.snapshot, { points: false }), STRIDE, time * 1000, frame);
    const beganMs = performance.now();
    map.take(frame);
    workMs.push(performance.now() - beganMs);
    // What was seen in the last second cannot be confirmed yet.
    if (i % KEY_FRAMES_PER_S === 0 && time < seconds - 2) {
      const snapshot = { ...base.snapshot, bodies: [] };
      addSeen(seen, truth.render(snapshot, { groundTruth: true, points: false }));
    }
  }
  camera.close();
  truth.close();
  const surfaces = new TrueSurfaces(world);
  const distancesM: number[] = [];
  let ghosts = 0;
  for (const [x, y, z] of rememberedPlaces(map)) {
    const distance = surfaces.distance(x, y, z);
    distancesM.push(distance);
    ghosts += Number(distance > GHOST_M);
  }
  const surfels = distancesM.length;
  return {
    remembered: rememberedShare(map, seen),
    distancesM,
    ghosts: ghosts / surfels,
    surfels,
    bytes: map.store.bytes,
    workMs,
  };
}

/** Adds the places that a picture shows. */
function addSeen(seen: number[], { depth, intrinsics, cameraPose }: CloudFrame): void {
  const { width, height } = intrinsics;
  for (let v = 0; v < height; v += TRUTH_STRIDE) {
    for (let u = 0; u < width; u += TRUTH_STRIDE) {
      const z = depth[v * width + u] as number;
      const place = placeOf(u, v, z, intrinsics, cameraPose);
      const { x, y, z: height } = cameraPose.position;
      if (z > 0 && Math.hypot(place[0] - x, place[1] - y, place[2] - height) < TRUTH_RANGE_M)
        seen.push(...place);
    }
  }
}

function placeOf(
  u: number,
  v: number,
  z: number,
  { fx, fy, cx, cy }: Readonly<CameraIntrinsics>,
  camera: Pose,
): [number, number, number] {
  const position = { x: ((u - cx) / fx) * z, y: ((v - cy) / fy) * z, z };
  const { position: place } = compose(camera, { position, orientation: { x: 0, y: 0, z: 0, w: 1 } });
  return [place.x, place.y, place.z];
}

/** What is confirmed, metres. */
export function* rememberedPlaces({ store }: WorldMap): Generator<[number, number, number]> {
  for (let page = 0; page < store.pages; page++) {
    const chunk = store.pageChunks[page] as number;
    if (chunk < 0) continue;
    const [cx, cy, cz] = [store.chunkX[chunk], store.chunkY[chunk], store.chunkZ[chunk]] as [
      number,
      number,
      number,
    ];
    for (let i = 0; i < (store.pageCounts[page] as number); i++) {
      const surfel = page * PAGE_SURFELS + i;
      if ((store.sightings[surfel] as number) < 2) continue;
      const place = store.places[surfel] as number;
      const metres = (corner: number, steps: number) => (corner + (steps + 0.5) / CHUNK_STEPS) * CHUNK_M;
      yield [metres(cx, place & 1023), metres(cy, (place >>> 10) & 1023), metres(cz, place >>> 20)];
    }
  }
}

/** Share of places that have something remembered within {@link NEAR_M}. */
function rememberedShare(map: WorldMap, seen: readonly number[]): number {
  const places = new Map<string, [number, number, number][]>();
  const cellOf = (x: number, y: number, z: number) =>
    `${Math.floor(x / NEAR_M)},${Math.floor(y / NEAR_M)},${Math.floor(z / NEAR_M)}`;
  for (const place of rememberedPlaces(map)) {
    const cell = cellOf(...place);
    const there = places.get(cell);
    if (there === undefined) places.set(cell, [place]);
    else there.push(place);
  }
  let found = 0;
  for (let i = 0; i < seen.length; i += 3) {
    const [x, y, z] = [seen[i], seen[i + 1], seen[i + 2]] as [number, number, number];
    found += Number(isNear(x, y, z));
  }
  return found / (seen.length / 3);

  function isNear(x: number, y: number, z: number): boolean {
    for (let dx = -1; dx <= 1; dx++) {
      for (let dy = -1; dy <= 1; dy++) {
        for (let dz = -1; dz <= 1; dz++) {
          const there = places.get(cellOf(x + dx * NEAR_M, y + dy * NEAR_M, z + dz * NEAR_M)) ?? [];
          if (there.some((place) => Math.hypot(place[0] - x, place[1] - y, place[2] - z) <= NEAR_M))
            return true;
        }
      }
    }
    return false;
  }
}
