/** A simulated robot among the walls, furniture and people of a simulated world, under the obstacle guard alone. */
import {
  concourseWorld,
  dockWorld,
  officeWorld,
  SimulatedBase,
  SimulatedCamera,
  SimulationError,
  type WorldDescription,
  warehouseWorld,
} from '@farpoint/sim';
import type { Codec } from '@farpoint/wasm-codec';
import { mountOf } from '../obstacles/guarded-sensors.ts';
import { type GuardedRun, type GuardTimes, guardedDrive, type StageCamera, seeded } from './guarded-drive.ts';

export type { GuardedRun, GuardTimes } from './guarded-drive.ts';

export const RUN_WORLDS: readonly (() => WorldDescription)[] = [
  officeWorld,
  warehouseWorld,
  concourseWorld,
  dockWorld,
];

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
): { world: WorldDescription; base: SimulatedBase } {
  for (;;) {
    const moved = shuffled(world, random);
    try {
      return { world: moved, base: placed(moved, random) };
    } catch (error) {
      if (!(error instanceof SimulationError)) throw error;
    }
  }
}

/** A base somewhere in its world with room around it. */
function placed(world: WorldDescription, random: () => number): SimulatedBase {
  const base = new SimulatedBase(world);
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

async function cameraOf(world: WorldDescription, base: SimulatedBase, seed: number) {
  const camera = await SimulatedCamera.create({ world, seed, camera: { width: SIZE, height: SIZE } });
  const { fx, fy, cx, cy } = camera.intrinsics;
  const mount = mountOf({ kind: 'sim', seed, size: SIZE }, null);
  if (mount === null) throw new Error('the simulated camera has a mount');
  const staged: StageCamera = {
    description: {
      ...{ kind: 'sim', width: SIZE, height: SIZE, capacity: SIZE * SIZE, depthMeasure: 'z' },
      camera: { fx, fy, cx, cy },
    },
    mount,
    blankIsMissing: true,
    render: () => camera.render(base.snapshot, { points: false }),
  };
  return { staged, close: () => camera.close() };
}

/** One run. The same world and seed give the same run. */
export async function guardedRun(
  codec: Codec,
  makeWorld: () => WorldDescription,
  seed: number,
  seconds = 12,
  times: GuardTimes | null = null,
): Promise<GuardedRun> {
  const random = seeded(seed);
  const { world, base } = begun(makeWorld(), random);
  const speed = 0.2 + 0.8 * random();
  const { staged, close } = await cameraOf(world, base, seed);
  return guardedDrive(
    codec,
    {
      ...{ name: world.name, base, cameras: [staged], close },
      clearanceAt: (x, y) => base.clearanceAt(x, y),
      edgeAt: (x, y) => base.edgeAt(x, y),
      touched: () => base.state.collision,
    },
    { seed, random, speed, seconds, times },
  );
}
