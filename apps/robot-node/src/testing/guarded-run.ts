/**
 * A simulated robot that is told to go full speed ahead among walls, furniture and people, under the obstacle guard alone:
 * camera, grid, guard and base as on the robot, in one thread and in simulated time.
 */
import { zeroTwist } from '@farpoint/protocol';
import { defaultObstacleGuardOptions, Footprint, ObstacleGuard, type SensorGrid } from '@farpoint/safety';
import {
  concourseWorld,
  DEFAULT_LIMITS,
  officeWorld,
  SimulatedBase,
  SimulatedCamera,
  SimulationError,
  type WorldDescription,
  warehouseWorld,
} from '@farpoint/sim';
import type { Codec } from '@farpoint/wasm-codec';
import type { SourceDescription } from '../capture/frame-source.ts';
import { CloudGuard } from '../obstacles/cloud-guard.ts';
import { mountOf } from '../obstacles/guarded-sensors.ts';
import { makeSharedGrid, SharedGridReader } from '../obstacles/shared-grid.ts';

export const RUN_WORLDS: readonly (() => WorldDescription)[] = [officeWorld, warehouseWorld, concourseWorld];

const SHAPE = { side: 160, cellM: 0.05 };
/** Pixels: fewer than the robot's own camera has, so that a run takes a second. */
const SIZE = 160;
const TICK_S = 0.01;
/** Ticks from one cloud to the next, and from its capture until the guard has it. */
const CLOUD_TICKS = 5;
const DELAY_TICKS = 3;
/** Ticks between two commands. */
const COMMAND_TICKS = 2;
/** Stopped for so long, the driver turns on the spot, s. */
const PATIENCE_S = 1;
/** More than this free on the way, beyond the guard's margin, and a stop there is false: metres, s. */
const AMPLE_M = 0.05;
const AHEAD_S = 0.6;

export interface GuardedRun {
  world: string;
  seed: number;
  /** Speed that was asked for, m/s. */
  speed: number;
  seconds: number;
  /** How far it went, metres. */
  metres: number;
  /** Times at which the robot drove into something, s. */
  contacts: { atS: number; speed: number }[];
  /** Commands for which the way was free, and those of them for which the guard stopped the robot. */
  freeCommands: number;
  falseStops: number;
  /** Commands for which the guard stopped the robot. */
  stops: number;
  commands: number;
}

/** How long the guard takes, for benchmarks: ms. */
export interface GuardTimes {
  now: () => number;
  boundMs: number[];
}

/** Uniform in [0, 1): mulberry32. */
function seeded(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 4_294_967_296;
  };
}

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
    if (base.clearanceAt(x, y) < 0.4 || !indoors(world, x, y)) continue;
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
  const camera = await SimulatedCamera.create({ world, seed, camera: { width: SIZE, height: SIZE } });
  const { fx, fy, cx, cy } = camera.intrinsics;
  const description: SourceDescription = {
    ...{ kind: 'sim', width: SIZE, height: SIZE, capacity: SIZE * SIZE, depthMeasure: 'z' },
    camera: { fx, fy, cx, cy },
  };
  const mount = mountOf({ kind: 'sim', seed, size: SIZE }, null);
  if (mount === null) throw new Error('the simulated camera has a mount');
  const memory = makeSharedGrid(SHAPE);
  const limits = { clearanceM: 0.04, heightM: 1.1, dropM: 0.15 };
  using clouds = new CloudGuard(codec, description, {
    memory,
    shape: SHAPE,
    mount,
    odometry: true,
    ...limits,
  });
  const reader = new SharedGridReader(memory, SHAPE);
  const guard = new ObstacleGuard(Footprint.disc(DEFAULT_LIMITS.radius), 1);

  const run: GuardedRun = {
    ...{ world: world.name, seed, speed, seconds, metres: 0, contacts: [] },
    ...{ freeCommands: 0, falseStops: 0, stops: 0, commands: 0 },
  };
  const wish = zeroTwist();
  const command = zeroTwist();
  const phase = random() * CLOUD_TICKS;
  let curvature = 0;
  let [stoppedS, turningS, turn] = [0, 0, 1];
  let waiting: { grid: SensorGrid; due: number } | null = null;
  let touching = false;
  const ticks = Math.round(seconds / TICK_S);
  for (let tick = 0; tick < ticks; tick++) {
    const nowMs = tick * TICK_S * 1000;
    if (Math.floor(tick + phase) % CLOUD_TICKS === 0) {
      const { depth, cameraPose } = camera.render(base.snapshot, { points: false });
      clouds.take({ form: 'images', depth, colour: NO_COLOUR, cameraPose, capturedAtMs: nowMs });
      const grid = reader.read();
      if (grid !== null) waiting = { grid, due: tick + DELAY_TICKS };
    }
    if (waiting !== null && tick >= waiting.due) {
      guard.see(0, waiting.grid);
      waiting = null;
    }
    if (tick % COMMAND_TICKS === 0) {
      const { pose, yaw, twist } = base.state;
      guard.moved({ x: pose.position.x, y: pose.position.y, yaw }, twist, nowMs);
      if (tick % 100 === 0) curvature = random() < 0.5 ? 0 : (random() * 2 - 1) * 1.2;
      turningS = Math.max(0, turningS - TICK_S * COMMAND_TICKS);
      wish.linear.x = turningS > 0 ? 0 : speed;
      wish.angular.z = turningS > 0 ? turn : curvature * speed;
      const began = times?.now() ?? 0;
      const { factor } = guard.bound(wish, nowMs);
      times?.boundMs.push(times.now() - began);
      const stopped = factor === 0;
      stoppedS = stopped ? stoppedS + TICK_S * COMMAND_TICKS : 0;
      if (stoppedS > PATIENCE_S) {
        [stoppedS, turningS, turn] = [0, 0.5 + 1.5 * random(), random() < 0.5 ? 1 : -1];
      }
      run.commands++;
      if (stopped) run.stops++;
      if (turningS === 0 && isFree(base, wish.linear.x, wish.angular.z)) {
        run.freeCommands++;
        if (stopped) run.falseStops++;
      }
      command.linear.x = wish.linear.x * factor;
      command.angular.z = wish.angular.z * factor;
      base.setCommand(command);
    }
    const before = base.state.twist.linear.x;
    base.step(TICK_S);
    const { collision } = base.state;
    if (collision && !touching) run.contacts.push({ atS: tick * TICK_S, speed: before });
    touching = collision;
  }
  run.metres = base.state.odometryDistance;
  camera.close();
  return run;
}

const NO_COLOUR = new Uint32Array();

/** Whether the arc is truly free: more than the guard's margin on all sides, as far as the robot needs to stop. */
function isFree(base: SimulatedBase, v: number, w: number): boolean {
  const { pose, yaw } = base.state;
  let [x, y, heading] = [pose.position.x, pose.position.y, yaw];
  for (let t = 0; t <= AHEAD_S + v; t += 0.05) {
    if (base.clearanceAt(x, y) < defaultObstacleGuardOptions.marginM + AMPLE_M) return false;
    x += v * 0.05 * Math.cos(heading);
    y += v * 0.05 * Math.sin(heading);
    heading += w * 0.05;
  }
  return true;
}
