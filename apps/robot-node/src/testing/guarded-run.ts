/** A simulated robot among the walls, furniture and people of a simulated world, under the obstacle guard alone. */
import {
  type CameraOptions,
  concourseWorld,
  DEFAULT_CAMERA,
  DEFAULT_LIMITS,
  dockWorld,
  officeWorld,
  SimulatedBase,
  SimulatedCamera,
  SimulationError,
  type WorldDescription,
  warehouseWorld,
} from '@farpoint/sim';
import type { Codec } from '@farpoint/wasm-codec';
import { opticalMount } from '../sense/sources/sensor-mount.ts';
import { type DrawnMount, drawMounts, radiusAround, towardsView } from './drawn-mounts.ts';
import { type GuardedRun, type GuardTimes, guardedDrive, type StageCamera, seeded } from './guarded-drive.ts';

export type { GuardedRun, GuardTimes } from './guarded-drive.ts';

export const RUN_WORLDS: readonly (() => WorldDescription)[] = [
  officeWorld,
  warehouseWorld,
  concourseWorld,
  dockWorld,
];

/** A robot that is nearer touches, metres. */
const TOUCHES_M = 0.005;
/** Pixels: fewer than the robot's own camera has, so that a run takes a second. */
const SIZE = 160;

/** People and carts somewhere else on their ways, at other speeds. */
function shuffled(world: WorldDescription, random: () => number): WorldDescription {
  const movers = world.movers.map((mover) => ({
    ...mover,
    offset: random() * 40,
    speed: mover.speed * (0.6 + 0.8 * random()),
  }));
  return { ...world, movers };
}

/** A world in which nobody stands where the robot starts, and a base in it. */
function begun(
  world: WorldDescription,
  random: () => number,
  radius: number,
): { world: WorldDescription; base: SimulatedBase } {
  for (;;) {
    const moved = shuffled(world, random);
    try {
      return { world: moved, base: placed(moved, random, radius) };
    } catch (error) {
      if (!(error instanceof SimulationError)) throw error;
    }
  }
}

/** A base somewhere in its world with room around it. */
function placed(world: WorldDescription, random: () => number, radius: number): SimulatedBase {
  const base = new SimulatedBase(world, { radius });
  for (let tries = 0; tries < 1000; tries++) {
    const [x, y] = [random() * 20, random() * 14];
    const room = Math.min(base.clearanceAt(x, y), base.edgeAt(x, y));
    if (room < 0.4 || !indoors(world, x, y)) continue;
    base.teleport(x, y, (random() * 2 - 1) * Math.PI);
    return base;
  }
  return base;
}

function indoors(world: WorldDescription, x: number, y: number): boolean {
  return world.panels.some(
    ({ level, centre, width, height }) =>
      level === 'up' && Math.abs(x - centre.x) < height / 2 && Math.abs(y - centre.y) < width / 2,
  );
}

/** How many sensors a run has, and where. */
export const RUN_SENSORS = ['camera', 'camera-and-floor', 'drawn'] as const;
export type RunSensors = (typeof RUN_SENSORS)[number];

/** Looks down at the floor around the robot, which the other camera does not see: in the robot's front, tilted. */
const FLOOR_CAMERA = { forward: 0.25, left: 0, up: 0.9, pitch: 1.2, yaw: 0, fieldOfView: 2 };
const FLOOR_SIZE = 120;

async function cameraOf(
  { world, base, seed }: { world: WorldDescription; base: SimulatedBase; seed: number },
  size: number,
  placed: Partial<DrawnMount> & Pick<CameraOptions, 'fieldOfView'>,
) {
  const camera = await SimulatedCamera.create({
    world,
    seed,
    camera: { width: size, height: size, ...placed },
  });
  const { fx, fy, cx, cy } = camera.intrinsics;
  const { forward: x, left: y, up: z, pitch, yaw } = { ...DEFAULT_CAMERA, ...placed };
  const staged: StageCamera = {
    description: {
      ...{ kind: 'sim', width: size, height: size, capacity: size * size, depthMeasure: 'z' },
      camera: { fx, fy, cx, cy },
    },
    mount: opticalMount({ x, y, z, roll: 0, pitch, yaw }),
    blankIsMissing: true,
    render: () => camera.render(base.snapshot, { points: false }),
  };
  return { staged, close: () => camera.close() };
}

export interface GuardedRunOptions {
  seconds?: number;
  times?: GuardTimes | null;
  /** With `camera-and-floor`, a second camera looks down at the floor around the robot. */
  sensors?: RunSensors;
}

/** One run. The same world, seed and options give the same run. */
export async function guardedRun(
  codec: Codec,
  makeWorld: () => WorldDescription,
  seed: number,
  { seconds = 12, times = null, sensors = 'camera' }: GuardedRunOptions = {},
): Promise<GuardedRun> {
  const random = seeded(seed);
  const mounts = sensors === 'drawn' ? drawMounts(random) : null;
  const radius = mounts === null ? DEFAULT_LIMITS.radius : radiusAround(mounts);
  const { world, base } = begun(makeWorld(), random, radius);
  const speed = 0.2 + 0.8 * random();
  const still = new SimulatedBase({ ...world, movers: [] }, { radius });
  const begins = { world, base, seed };
  const cameras = mounts === null ? [await cameraOf(begins, SIZE, {})] : [];
  // Another seed each, so that no two cameras have the same noise.
  if (sensors === 'camera-and-floor')
    cameras.push(await cameraOf({ ...begins, seed: seed + 100_000 }, FLOOR_SIZE, FLOOR_CAMERA));
  for (const [i, mount] of (mounts ?? []).entries())
    cameras.push(await cameraOf({ ...begins, seed: seed + i * 100_000 }, SIZE, mount));
  return guardedDrive(
    codec,
    {
      ...{ name: world.name, base, radius, cameras: cameras.map(({ staged }) => staged) },
      close: () => {
        for (const { close } of cameras) close();
      },
      clearanceAt: (x, y) => base.clearanceAt(x, y),
      edgeAt: (x, y) => base.edgeAt(x, y),
      isStill: (x, y) => still.clearanceAt(x, y) < TOUCHES_M,
      touched: () => base.state.collision,
    },
    { seed, random, speed: mounts === null ? speed : speed * towardsView(mounts), seconds, times },
  );
}
