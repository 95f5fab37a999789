/**
 * A robot that is told to go full speed ahead under the obstacle guard alone: grid, guard and base as on the robot, in one
 * thread and in simulated time. What is around it, and what its sensors see of that, is up to the stage.
 */

import type { SourceDescription } from '@farpoint/cloud-source';
import { type Pose, zeroTwist } from '@farpoint/protocol';
import {
  defaultObstacleGuardOptions,
  Footprint,
  type MotionGuard,
  ObstacleGuard,
  type SensorGrid,
} from '@farpoint/safety';
import type { SimulatedBase } from '@farpoint/sim';
import type { Codec } from '@farpoint/wasm-codec';
import { GRID_SHAPE } from '../motion/obstacles/guarded-sensors.ts';
import { CloudGuard } from '../sense/obstacles/cloud-guard.ts';
import { makeSharedGrid, SharedGridReader } from '../sense/obstacles/shared-grid.ts';
import { SeenThings } from './seen-things.ts';

/** A depth camera on the robot. */
export interface StageCamera {
  description: SourceDescription;
  /** Its optical frame in base_link. */
  mount: Pose;
  /** Whether floor that it should see and does not is missing. */
  blankIsMissing: boolean;
  /** What it sees now. */
  render(): { depth: Float32Array; cameraPose: Pose };
}

/** Where a robot drives. Distances are from the robot's edge, metres. */
export interface GuardedStage {
  name: string;
  base: SimulatedBase;
  /** Of the round robot. */
  radius: number;
  cameras: readonly StageCamera[];
  /** To the nearest thing, of a robot that would stand there; negative inside one. */
  clearanceAt(x: number, y: number): number;
  /** To the nearest hole or edge of the floor; infinite where there is none. */
  edgeAt(x: number, y: number): number;
  /** Whether what a robot touches that stands there never moves. */
  isStill(x: number, y: number): boolean;
  /** Whether the robot drove into something since the last step. */
  touched(): boolean;
  close(): void;
}

const STEP_S = 0.01;
/** Steps from one cloud to the next, and from its capture until the guard has it. */
const CLOUD_STEPS = 5;
const DELAY_STEPS = 3;
/** Steps between two commands. */
const COMMAND_STEPS = 2;
/** Stopped for so long, the driver turns on the spot, s. */
const PATIENCE_S = 1;
/** More than this free on the way, beyond the guard's margin, and a stop there is false: metres, s. */
const AMPLE_M = 0.05;
const AHEAD_S = 0.6;
/** What a sensor has seen for so long, the guard must know and the robot stand before: ms. */
const KNOWN_MS = 500;
/** What moves is no longer known to be where it was last seen so long ago, ms. */
const MOVED_ON_MS = 1000;
const BAND = { clearanceM: 0.04, heightM: 1.1, dropM: 0.15 };
const NO_COLOUR = new Uint32Array();

export interface Contact {
  atS: number;
  /** Signed, m/s. */
  speed: number;
}

export interface GuardedRun {
  world: string;
  seed: number;
  /** Speed that was asked for, m/s. */
  speed: number;
  seconds: number;
  /** How far it went, metres. */
  metres: number;
  /** Times at which the robot drove into something that its sensors had seen, s. */
  contacts: Contact[];
  /** The same with what none of them had seen: nothing but the robot's slowness guards it from that. */
  unseenContacts: Contact[];
  /** When its edge came over a hole or an edge of the floor, s; the run ends there. */
  fellAtS: number | null;
  /** Whether that was into a hole that no sensor had seen. */
  fellUnseen: boolean;
  /** How near its edge came to one, metres; infinite where there is none. */
  nearestEdgeM: number;
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
  /** What asks the guard, in place of the drive itself. */
  around?: (guard: ObstacleGuard) => MotionGuard;
}

export interface GuardedDriveOptions {
  seed: number;
  /** Continues the sequence that placed the robot. */
  random: () => number;
  /** Asked for, m/s; negative: backwards. */
  speed: number;
  seconds: number;
  times?: GuardTimes | null;
}

/** Uniform in [0, 1): mulberry32. */
export function seeded(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 4_294_967_296;
  };
}

/** The guard's end of a camera. */
class GuardedCamera implements Disposable {
  readonly #camera: StageCamera;
  readonly #clouds: CloudGuard;
  readonly #reader: SharedGridReader;
  #waiting: { grid: SensorGrid; due: number } | null = null;

  constructor(codec: Codec, camera: StageCamera) {
    const memory = makeSharedGrid(GRID_SHAPE);
    const { description, mount } = camera;
    this.#camera = camera;
    this.#clouds = new CloudGuard(codec, description, {
      ...{ memory, shape: GRID_SHAPE, mount, odometry: true, ...BAND },
      blankIsMissing: camera.blankIsMissing,
    });
    this.#reader = new SharedGridReader(memory, GRID_SHAPE);
  }

  capture(capturedAtMs: number, step: number, seen: SeenThings): void {
    const { depth, cameraPose } = this.#camera.render();
    const { camera, width } = this.#camera.description;
    if (camera !== null) seen.take(depth, width, camera, cameraPose, capturedAtMs);
    this.#clouds.take({ form: 'images', depth, colour: NO_COLOUR, cameraPose, capturedAtMs });
    const grid = this.#reader.read();
    if (grid !== null) this.#waiting = { grid, due: step + DELAY_STEPS };
  }

  /** The grid that has reached the guard by now, once. */
  arrived(step: number): SensorGrid | null {
    if (this.#waiting === null || step < this.#waiting.due) return null;
    const { grid } = this.#waiting;
    this.#waiting = null;
    return grid;
  }

  [Symbol.dispose](): void {
    this.#clouds[Symbol.dispose]();
  }
}

/** Drives on a stage. The same stage and options give the same run. Closes the stage. */
export function guardedDrive(codec: Codec, stage: GuardedStage, options: GuardedDriveOptions): GuardedRun {
  using stack = new DisposableStack();
  stack.defer(() => stage.close());
  const cameras = stage.cameras.map((camera) => stack.use(new GuardedCamera(codec, camera)));
  const robot = new GuardedRobot(stage, cameras, options);
  const steps = Math.round(options.seconds / STEP_S);
  for (let step = 0; step < steps && robot.run.fellAtS === null; step++) robot.step(step);
  robot.run.metres = stage.base.state.odometryDistance;
  return robot.run;
}

/** A robot with its driver, who only ever goes straight ahead or along an arc, and turns where it cannot go on. */
class GuardedRobot {
  readonly run: GuardedRun;
  readonly #stage: GuardedStage;
  readonly #cameras: readonly GuardedCamera[];
  readonly #options: GuardedDriveOptions;
  readonly #guard: ObstacleGuard;
  readonly #asked: MotionGuard;
  readonly #seen: SeenThings;
  readonly #wish = zeroTwist();
  readonly #command = zeroTwist();
  /** Part of a period of its cameras by which they are ahead of the drive, steps. */
  readonly #phase: number;
  #curvature = 0;
  #stoppedS = 0;
  #turningS = 0;
  #turn = 1;
  #touching = false;

  constructor(stage: GuardedStage, cameras: readonly GuardedCamera[], options: GuardedDriveOptions) {
    const { seed, random, speed, seconds, times } = options;
    const isHole = (x: number, y: number) => stage.edgeAt(x, y) + stage.radius <= 0;
    this.#stage = stage;
    this.#cameras = cameras;
    this.#options = options;
    this.#guard = new ObstacleGuard(Footprint.disc(stage.radius), cameras.length);
    this.#seen = new SeenThings(stage.base.state.pose.position, isHole);
    this.#asked = times?.around?.(this.#guard) ?? this.#guard;
    this.#phase = random() * CLOUD_STEPS;
    this.run = {
      world: stage.name,
      seed,
      speed,
      seconds,
      metres: 0,
      contacts: [],
      unseenContacts: [],
      fellAtS: null,
      fellUnseen: false,
      nearestEdgeM: Number.POSITIVE_INFINITY,
      freeCommands: 0,
      falseStops: 0,
      stops: 0,
      commands: 0,
    };
  }

  step(step: number): void {
    const { base } = this.#stage;
    const nowMs = step * STEP_S * 1000;
    this.#see(step, nowMs);
    if (step % COMMAND_STEPS === 0) this.#drive(step, nowMs);
    const before = base.state.twist.linear.x;
    base.step(STEP_S);
    this.#noteContact(step, nowMs, before);
    this.#noteEdge(step, nowMs);
  }

  #see(step: number, nowMs: number): void {
    this.#cameras.forEach((camera, sensor) => {
      if (Math.floor(step + this.#phase) % CLOUD_STEPS === 0) camera.capture(nowMs, step, this.#seen);
      const grid = camera.arrived(step);
      if (grid !== null) this.#guard.see(sensor, grid);
    });
  }

  /** Wishes, asks the guard and commands the wheels. */
  #drive(step: number, nowMs: number): void {
    const { base } = this.#stage;
    const { times = null } = this.#options;
    const { pose, yaw, twist } = base.state;
    this.#guard.moved({ x: pose.position.x, y: pose.position.y, yaw }, twist, nowMs);
    this.#makeWish(step);
    const began = times?.now() ?? 0;
    const { factor } = this.#asked.bound(this.#wish, nowMs);
    times?.boundMs.push(times.now() - began);
    this.#losePatience(factor === 0);
    this.#count(factor === 0);
    this.#command.linear.x = this.#wish.linear.x * factor;
    this.#command.angular.z = this.#wish.angular.z * factor;
    base.setCommand(this.#command);
  }

  #makeWish(step: number): void {
    const { random, speed } = this.#options;
    if (step % 100 === 0) this.#curvature = random() < 0.5 ? 0 : (random() * 2 - 1) * 1.2;
    this.#turningS = Math.max(0, this.#turningS - STEP_S * COMMAND_STEPS);
    this.#wish.linear.x = this.#turningS > 0 ? 0 : speed;
    this.#wish.angular.z = this.#turningS > 0 ? this.#turn : this.#curvature * speed;
  }

  /** After a while of standing before something, the driver turns. */
  #losePatience(stopped: boolean): void {
    const { random } = this.#options;
    this.#stoppedS = stopped ? this.#stoppedS + STEP_S * COMMAND_STEPS : 0;
    if (this.#stoppedS <= PATIENCE_S) return;
    this.#stoppedS = 0;
    this.#turningS = 0.5 + 1.5 * random();
    this.#turn = random() < 0.5 ? 1 : -1;
  }

  #count(stopped: boolean): void {
    const { run } = this;
    run.commands++;
    if (stopped) run.stops++;
    if (this.#turningS !== 0 || !isFree(this.#stage, this.#wish.linear.x, this.#wish.angular.z)) return;
    run.freeCommands++;
    if (stopped) run.falseStops++;
  }

  #noteContact(step: number, nowMs: number, speed: number): void {
    const { base, radius } = this.#stage;
    const touched = this.#stage.touched();
    const { x, y } = base.state.pose.position;
    if (touched && !this.#touching) {
      const lastMs = this.#stage.isStill(x, y) ? Number.NEGATIVE_INFINITY : nowMs - MOVED_ON_MS;
      const isKnown = nowMs - this.#seen.thingSinceMs({ x, y }, radius, lastMs) > KNOWN_MS;
      (isKnown ? this.run.contacts : this.run.unseenContacts).push({ atS: step * STEP_S, speed });
    }
    this.#touching = touched;
  }

  #noteEdge(step: number, nowMs: number): void {
    const { base, radius } = this.#stage;
    const { run } = this;
    const { x, y } = base.state.pose.position;
    run.nearestEdgeM = Math.min(run.nearestEdgeM, this.#stage.edgeAt(x, y));
    if (run.nearestEdgeM < 0) {
      run.fellAtS = step * STEP_S;
      run.fellUnseen = !(nowMs - this.#seen.holeSinceMs({ x, y }, radius) > KNOWN_MS);
    }
  }
}

/** Whether the arc is truly free: more than the guard's margin on all sides, as far as the robot needs to stop. */
function isFree(stage: GuardedStage, v: number, w: number): boolean {
  const { pose, yaw } = stage.base.state;
  let [x, y, heading] = [pose.position.x, pose.position.y, yaw];
  for (let t = 0; t <= AHEAD_S + Math.abs(v); t += 0.05) {
    const room = Math.min(stage.clearanceAt(x, y), stage.edgeAt(x, y));
    if (room < defaultObstacleGuardOptions.marginM + AMPLE_M) return false;
    x += v * 0.05 * Math.cos(heading);
    y += v * 0.05 * Math.sin(heading);
    heading += w * 0.05;
  }
  return true;
}
