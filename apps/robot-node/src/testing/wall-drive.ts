/**
 * A robot that drives at a wall under its obstacle guard, in simulated time, with exact knowledge of where it really is. What
 * its sensor sees goes through one of the robot's own sources, with whatever times and frames that is given.
 */

import type { CaptureRoom, FrameSource } from '@farpoint/cloud-source';
import { compose, type Pose, rotationMatrix, type Twist, zeroTwist } from '@farpoint/protocol';
import { defaultGeofenceOptions, EarthFrame, Footprint, FREE } from '@farpoint/safety';
import type { Codec } from '@farpoint/wasm-codec';
import { type OpenedGeofence, openGeofence } from '../motion/geofence/open-geofence.ts';
import { GRID_SHAPE } from '../motion/obstacles/guarded-sensors.ts';
import { ObstacleStation } from '../motion/obstacles/obstacle-station.ts';
import { BaseOdometry } from '../sense/base/base-odometry.ts';
import { CloudGuard } from '../sense/obstacles/cloud-guard.ts';
import { makeSharedGrid, SharedGridReader } from '../sense/obstacles/shared-grid.ts';
import { bodyMount, opticalMount, type SensorMount } from '../sense/sources/sensor-mount.ts';

/** What is true at an instant. */
export interface WallTruth {
  nowMs: number;
  /** How far along x it is, and at what speed. */
  x: number;
  speed: number;
  base: Pose;
  twist: Twist;
  /** x, y, z of what the sensor sees, in its body's axes. */
  points: Float32Array;
}

export interface WallDrive {
  /** The sensor, as it really sits. */
  mount: SensorMount;
  /** As the guard is told; default: as it sits. */
  told?: SensorMount;
  source: FrameSource;
  /** Whether something is to say where the robot is. */
  odometry: boolean;
  /** Gives the source what is true, or anything else. Called every 50 ms. */
  feed(truth: WallTruth): void;
  /** Asked for; negative: backwards. */
  speed?: number;
  seconds?: number;
  /** How far from where it begins it may go, m. */
  fenceM?: number;
  /** The satellite receiver that says where the robot is in its fence; default: odometry does. */
  fixTopic?: string | undefined;
  /** From the robot's edge to the wall at the start, m. */
  wallM?: number;
  /** Moves on the clock that the source reads. */
  setNow(nowMs: number): void;
}

/** Where drives begin on the earth, looking east. */
export const EARTH = new EarthFrame({ latitude: 48, longitude: 11, turnDeg: 0 });

export interface WallDriven {
  /** From the robot's edge to the wall at the end; negative inside it. */
  gapM: number;
  /** How fast it came to the wall, m/s; `null` if it did not. */
  contactMps: number | null;
  /** How far its edge came out of the fence; negative if it did not. */
  outsideM: number;
  /** The fastest that it went. */
  fastestMps: number;
}

const RADIUS = 0.25;
const STEP_MS = 10;
const CLOUD_MS = 50;
const BAND = { clearanceM: 0.04, heightM: 1.1, dropM: 0.15 };
/** The robot's edge is so far from the wall at the start, m. */
const START_M = 1.5;
const HEIGHT_M = 2;
const FAR_M = 10;
const ACCELERATION = 1;
const BRAKES = 2;

/** All directions in which the sensor looks. */
const RAYS = (() => {
  const rays: number[] = [];
  for (let elevation = -80; elevation <= 20; elevation += 3)
    for (let azimuth = -180; azimuth < 180; azimuth += 2.5) {
      const [e, a] = [(elevation * Math.PI) / 180, (azimuth * Math.PI) / 180];
      rays.push(Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e));
    }
  return Float64Array.from(rays);
})();
export const WALL_POINTS = RAYS.length / 3;

/** What a sensor at this pose sees of the floor and of a wall across x, in its body's axes. */
function look({ position, orientation }: Pose, wallX: number): Float32Array {
  const [r0, r1, r2, , , , r6, r7, r8] = rotationMatrix(orientation);
  const seen = new Float32Array(RAYS.length);
  let count = 0;
  for (let i = 0; i < RAYS.length; i += 3) {
    const [x, y, z] = [RAYS[i] as number, RAYS[i + 1] as number, RAYS[i + 2] as number];
    const [dx, dz] = [r0 * x + r1 * y + r2 * z, r6 * x + r7 * y + r8 * z];
    const toWall = (wallX - position.x) / dx;
    const toFloor = -position.z / dz;
    const hitsWall = toWall > 0 && position.z + dz * toWall < HEIGHT_M;
    const far = Math.min(hitsWall ? toWall : FAR_M, toFloor > 0 ? toFloor : FAR_M);
    if (!(far < FAR_M)) continue;
    seen[count++] = x * far;
    seen[count++] = y * far;
    seen[count++] = z * far;
  }
  return seen.subarray(0, count);
}

/** Drives at the wall until the time is over or the robot is in it. Closes nothing. */
export function driveAtWall(codec: Codec, drive: WallDrive): WallDriven {
  using robot = new WallRobot(codec, drive);
  const { seconds = 6 } = drive;
  for (let ms = 0; ms < seconds * 1000 && robot.driven.contactMps === null; ms += STEP_MS) robot.step(ms);
  return robot.driven;
}

class WallRobot implements Disposable {
  readonly driven: WallDriven;
  readonly #drive: WallDrive;
  readonly #wallX: number;
  readonly #clouds: CloudGuard;
  readonly #station: ObstacleStation;
  readonly #believed: BaseOdometry;
  readonly #fence: OpenedGeofence | null;
  readonly #room: CaptureRoom;
  readonly #wish = zeroTwist();
  #x = 0;
  #speed = 0;

  constructor(codec: Codec, drive: WallDrive) {
    const { mount, told = mount, source, odometry, speed = 0.6, wallM = START_M } = drive;
    this.#drive = drive;
    this.#wish.linear.x = speed;
    this.#wallX = Math.sign(speed) * (RADIUS + wallM);
    const memory = makeSharedGrid(GRID_SHAPE);
    this.#clouds = new CloudGuard(codec, source.description, {
      memory,
      shape: GRID_SHAPE,
      mount: opticalMount(told),
      odometry: true,
      ...BAND,
    });
    this.#station = new ObstacleStation({
      configuration: {
        mode: 'on',
        footprint: Footprint.disc(RADIUS).corners,
        ...BAND,
        marginM: 0.15,
        unseenMps: 0.3,
        brakes: { linear: BRAKES, angular: 3 },
      },
      grids: [{ sensor: 0, reader: new SharedGridReader(memory, GRID_SHAPE) }],
      captures: [],
      odometry,
    });
    this.#believed = new BaseOdometry({ maxLinear: Math.abs(speed), maxAngular: 1 }, false);
    this.#fence = openFence(drive, this.#believed);
    this.#room = {
      points: new Float32Array(source.description.capacity * 4),
      depth: new Float32Array(),
      colour: new Uint32Array(),
    };
    this.driven = { gapM: wallM, contactMps: null, outsideM: Number.NEGATIVE_INFINITY, fastestMps: 0 };
  }

  /** @param ms since the drive began */
  step(ms: number): void {
    const { source, setNow } = this.#drive;
    const nowMs = BEGAN_MS + ms;
    setNow(nowMs);
    source.onReading = (reading) => this.#fence?.fix?.take(reading, nowMs);
    if (ms % CLOUD_MS === 0) this.#see(nowMs);
    this.#believed.take({ ...source.state, timeMs: nowMs });
    this.#station.update(this.#believed, true);
    // Nothing is asked of the robot before its sensor can have been seen.
    this.#move(ms < 1200 ? zeroTwist() : this.#wish, nowMs);
    this.#measure();
  }

  #see(nowMs: number): void {
    const { source, mount, feed } = this.#drive;
    const [x, speed] = [this.#x, this.#speed];
    const base = { position: { x, y: 0, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } };
    const twist = { ...zeroTwist(), linear: { x: speed, y: 0, z: 0 } };
    const points = look(compose(base, bodyMount(mount)), this.#wallX);
    feed({ nowMs, x, speed, base, twist, points });
    const frame = source.capture(nowMs, { bitsPerSecond: 0, latencyTest: false }, this.#room);
    if (frame !== null) this.#clouds.take(frame);
  }

  #move(asked: Twist, nowMs: number): void {
    const bounds = [this.#station.bound(asked, nowMs), this.#fence?.geofence.bound(asked, nowMs) ?? FREE];
    const urgent = bounds.some((bound) => bound.urgent);
    const target = asked.linear.x * Math.min(...bounds.map(({ factor }) => factor));
    this.#believed.told({ ...zeroTwist(), linear: { x: target, y: 0, z: 0 } }, nowMs);
    const brakes = urgent || Math.abs(target) < Math.abs(this.#speed);
    const most = ((brakes ? BRAKES : ACCELERATION) * STEP_MS) / 1000;
    this.#speed += Math.max(-most, Math.min(most, target - this.#speed));
    this.#x += (this.#speed * STEP_MS) / 1000;
  }

  #measure(): void {
    const { driven } = this;
    const { fenceM } = this.#drive;
    driven.gapM = Math.abs(this.#wallX) - RADIUS - Math.sign(this.#wallX) * this.#x;
    if (fenceM !== undefined)
      driven.outsideM = Math.max(driven.outsideM, Math.abs(this.#x) + RADIUS - fenceM);
    driven.fastestMps = Math.max(driven.fastestMps, Math.abs(this.#speed));
    if (driven.gapM <= 0) driven.contactMps = Math.abs(this.#speed);
  }

  [Symbol.dispose](): void {
    this.#clouds[Symbol.dispose]();
  }
}

function openFence({ fenceM, fixTopic }: WallDrive, believed: BaseOdometry): OpenedGeofence | null {
  if (fenceM === undefined) return null;
  return openGeofence(
    {
      fence: { allowed: [], forbidden: [], slow: [], radiusM: fenceM },
      errorM: 0,
      fix: fixTopic === undefined ? null : { topic: fixTopic, earth: EARTH },
      limits: { ...defaultGeofenceOptions, radiusM: RADIUS, brakeMps2: BRAKES / 2 },
    },
    () => believed.believed,
    false,
  );
}

/** When the drive begins, ms. */
export const BEGAN_MS = 5000;

/** x, y, z and a colour each, in the optical axes of the same sensor. */
export function opticalPoints(points: Float32Array, length: number): Float32Array {
  const turned = new Float32Array(length * 4).fill(Number.NaN);
  for (let i = 0; i < points.length / 3; i++) {
    const [x, y, z] = [points[i * 3] as number, points[i * 3 + 1] as number, points[i * 3 + 2] as number];
    turned.set([-y, -z, x, 0], i * 4);
  }
  return turned;
}

/** Where the optical frame of a sensor is in the world. */
export function opticalPose(base: Pose, mount: SensorMount): Pose {
  return compose(base, opticalMount(mount));
}
