/** `pnpm bench guard`: a kernel benchmark of the obstacle guard. */
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { decodeDepthPng, decodePcd, parseIntrinsics } from '@farpoint/cloud-formats';
import { BlankFloor } from '@farpoint/robot-node/obstacles/blank-floor';
import { opticalMount } from '@farpoint/robot-node/obstacles/sensor-mount';
import { guardedRun, RUN_WORLDS } from '@farpoint/robot-node/testing/guarded-run';
import type { MotionGuard, ObstacleGuard } from '@farpoint/safety';
import { DEFAULT_CAMERA, dockWorld, officeWorld, SimulatedBase, SimulatedCamera } from '@farpoint/sim';
import { type Codec, ObstacleGrid, type SeenCells } from '@farpoint/wasm-codec';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { benchOptions, option } from './bench-options.ts';
import { type Bench, distributionCells, printJson, printTable } from './report.ts';
import { type Distribution, distribution, rounded, timeCalls } from './stats.ts';

const USAGE = `pnpm bench guard [--rounds 300] [--clouds ../shared/data/clouds] [--json]

Kernel benchmark, in one process. Times the step from a whole cloud to the grid of the floor, for the simulated camera's
480 × 480 pixels as an image and as points, and for recorded clouds where the folder has them. The copy into WASM is
included, and so is the search for missing floor of which an image has no depth. Then the guard's decision for one command, and the near field that operators are told, in simulated drives.`;

const SETTINGS = {
  side: 160,
  cellM: 0.05,
  clearanceM: 0.04,
  heightM: 1.1,
  dropM: 0.15,
  slope: 0.01,
  lowRayM: 0.15,
  nearPoints: 14,
  leastPoints: 2,
  confirm: false,
};

const HERE = { x: 0, y: 0, yaw: 0 };

interface Row {
  cloud: string;
  points: number;
  seen: SeenCells;
  ms: Distribution;
}

/** Optical axes at a height, looking ahead and down by an angle: rotation row by row, then position. */
function poseOf(up: number, pitch: number): number[] {
  const [c, s] = [Math.cos(pitch), Math.sin(pitch)];
  return [0, -s, c, -1, 0, 0, 0, -c, -s, 0, 0, up];
}

export const bench: Bench = {
  name: 'guard',
  summary: 'kernel: time of the obstacle guard, per cloud and per command',
  usage: USAGE,
  async run(argv) {
    const { rounds, clouds, json } = benchOptions(argv, {
      rounds: option.number(300, { least: 1 }),
      clouds: option.text(join(import.meta.dirname, '../../../shared/data/clouds')),
    });
    const codec = await loadCodecFromDisk();
    const rows = [...(await simulated(codec, rounds)), ...recorded(codec, clouds, rounds)];
    const boundMs: number[] = [];
    for (const [i, world] of RUN_WORLDS.entries()) {
      await guardedRun(codec, world, i + 1, { times: { now: () => performance.now(), boundMs } });
    }
    const bound = rounded(distribution(boundMs), 4);
    const nearMs: number[] = [];
    for (const [i, world] of RUN_WORLDS.entries()) {
      const around = (guard: ObstacleGuard) => timingNearField(guard, nearMs);
      await guardedRun(codec, world, i + 1, { times: { now: () => performance.now(), boundMs: [], around } });
    }
    const near = rounded(distribution(nearMs), 3);

    printTable(
      ['cloud', 'points', 'free', 'occupied', 'drop-offs', 'p50 ms', 'p95', 'p99', 'max'],
      rows.map(({ cloud, points, seen, ms }) => [
        cloud,
        points,
        seen.free,
        seen.occupied,
        seen.dropOffs,
        ...distributionCells(ms),
      ]),
    );
    console.log(`a command: p50 ${bound.p50} ms, p95 ${bound.p95} ms, max ${bound.max} ms`);
    console.log(`the near field: p50 ${near.p50} ms, p95 ${near.p95} ms, max ${near.max} ms`);
    if (json) printJson({ bench: 'guard', guardMs: rows[0]?.ms, boundMs: bound, nearMs: near, rows });
  },
};

/** Asks for the near field before each command. */
function timingNearField(guard: ObstacleGuard, nearMs: number[]): MotionGuard {
  return {
    bound: (wish, nowMs) => {
      const began = performance.now();
      guard.nearField(nowMs);
      nearMs.push(performance.now() - began);
      return guard.bound(wish, nowMs);
    },
  };
}

/** For the simulated camera's clouds of 230,400 points. */
export async function simulatedGuardMs(codec: Codec, rounds: number): Promise<Distribution> {
  const [image] = await simulated(codec, rounds);
  if (image === undefined) throw new Error('nothing was timed');
  return image.ms;
}

async function simulated(codec: Codec, rounds: number): Promise<Row[]> {
  const pose = poseOf(DEFAULT_CAMERA.up, DEFAULT_CAMERA.pitch);
  const rows: Row[] = [];
  for (const world of [officeWorld(), dockWorld()]) {
    const camera = await SimulatedCamera.create({ world, seed: 1 });
    const base = new SimulatedBase(world);
    // Before the edge.
    if (world.name === 'dock') base.teleport(12.4, 9, 0);
    const { depth, points, intrinsics } = camera.render(base.snapshot);
    rows.push(timeImage(codec, `${world.name}, image`, depth, intrinsics, pose, rounds));
    if (world.name !== 'dock') rows.push(timePoints(codec, `${world.name}, points`, points, pose, rounds));
    camera.close();
  }
  return rows;
}

/** Each recorded cloud as if its camera stood 1 m above the floor. */
function recorded(codec: Codec, folder: string, rounds: number): Row[] {
  const rows: Row[] = [];
  const skipped: string[] = [];
  for (const name of ['kinect-room.pcd', 'stereo-table.pcd', 'lidar-street.pcd']) {
    const file = join(folder, name);
    if (!existsSync(file)) skipped.push(name);
    else rows.push(timePoints(codec, name, decodePcd(readFileSync(file)).points, poseOf(1, 0), rounds));
  }
  const images = join(folder, 'rgbd-sequence');
  const [depthFile, cameraFile] = ['depth_00000.png', 'camera_primesense.json'].map((it) => join(images, it));
  if (!existsSync(depthFile as string) || !existsSync(cameraFile as string)) skipped.push('rgbd-sequence');
  else {
    const camera = parseIntrinsics(readFileSync(cameraFile as string, 'utf8'));
    const { millimetres } = decodeDepthPng(readFileSync(depthFile as string));
    const depth = Float32Array.from(millimetres, (mm) => mm / 1000);
    rows.push(timeImage(codec, 'rgbd-sequence', depth, camera, poseOf(1, 0), rounds));
  }
  if (skipped.length > 0) console.log(`skipped, not in ${folder}: ${skipped.join(', ')}`);
  return rows;
}

function timeImage(
  codec: Codec,
  cloud: string,
  depth: Float32Array,
  camera: { width: number; height: number; fx: number; fy: number; cx: number; cy: number },
  pose: readonly number[],
  rounds: number,
): Row {
  using grid = new ObstacleGrid(codec, depth.length, SETTINGS);
  grid.setCamera(camera, camera);
  grid.pose.set(pose);
  const { up: z, pitch } = DEFAULT_CAMERA;
  const mount = opticalMount({ x: 0, y: 0, z, roll: 0, pitch, yaw: 0 });
  const blank = new BlankFloor(camera, mount, SETTINGS);
  const look = () => {
    grid.depth.set(depth);
    const seen = grid.look('image');
    blank.mark(depth, HERE, grid.classes);
    return seen;
  };
  return {
    cloud,
    points: depth.length,
    seen: look(),
    ms: rounded(distribution(timeCalls(look, rounds)), 3),
  };
}

function timePoints(
  codec: Codec,
  cloud: string,
  given: Float32Array,
  pose: readonly number[],
  rounds: number,
): Row {
  // A view of a module's memory may be moved away by the grid's own.
  const frame = given.slice();
  const points = frame.length / 4;
  using grid = new ObstacleGrid(codec, points, SETTINGS);
  grid.pose.set(pose);
  const look = () => {
    grid.points.set(frame);
    return grid.look({ points });
  };
  return { cloud, points, seen: look(), ms: rounded(distribution(timeCalls(look, rounds)), 3) };
}
