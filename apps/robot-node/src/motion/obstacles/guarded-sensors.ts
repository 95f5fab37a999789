import type { Pose } from '@farpoint/protocol';
import type { Corner } from '@farpoint/safety';
import { type CameraOptions, DEFAULT_CAMERA, FLOOR_CAMERAS } from '@farpoint/sim';
import type { CaptureOptions } from '../../sense/capture/capture-messages.ts';
import { type GridShape, makeSharedGrid, SharedGridReader } from '../../sense/obstacles/shared-grid.ts';
import type { SourceOptions } from '../../sense/sources/open-source.ts';
import { opticalMount } from '../../sense/sources/sensor-mount.ts';
import { lidarHeight } from '../../sense/sources/sim-lidar-source.ts';
import type { GuardTopicsOptions } from './guard-topics-messages.ts';

/** The obstacle guard as configured. Lengths in metres, speeds in m/s. */
export interface ObstacleGuardConfiguration {
  /** `auto`: on if it is known where the sensors sit. */
  mode: 'auto' | 'on' | 'off';
  footprint: readonly Corner[];
  clearanceM: number;
  heightM: number;
  dropM: number;
  marginM: number;
  unseenMps: number;
  /** How hard the base brakes: m/s² and rad/s². */
  brakes: { linear: number; angular: number };
  /** The topics of the robot's ROS graph that bound its motion as well. */
  topics?: GuardTopicsOptions | null | undefined;
  /** Whether floor that a camera should see and does not counts as missing. */
  blankIsMissing?: boolean | undefined;
  /** Whether floor over which a laser scan passes counts as seen. */
  scansShowFloor?: boolean | undefined;
}

/** The simulated robot's floor cameras, with what they are called where the guard's sensors are listed. */
const SIM_FLOOR: readonly { looks: string; place: CameraOptions }[] = [
  { looks: 'floor ahead', place: FLOOR_CAMERAS.ahead },
  { looks: 'floor behind', place: FLOOR_CAMERAS.behind },
];

/** Around base_link: 4 m in each direction. */
export const GRID_SHAPE: GridShape = { side: 160, cellM: 0.05 };

/** The sensors with the guard's part of their capture threads, and its ends of their grids. */
export interface GuardedSensors<Sensor> {
  sensors: readonly (Sensor & { capture: CaptureOptions })[];
  /** One for each guarded sensor; empty if the guard is off. */
  grids: readonly GuardedGrid[];
  /** Whether something is to say where the robot is. */
  odometry: boolean;
}

/** The guard's end of a grid. */
export interface GuardedGrid {
  /** The sensor whose thread writes it. */
  sensor: number;
  /** What it is of, if it is not of the sensor's clouds. */
  looks?: string;
  reader: SharedGridReader;
}

/** Gives the capture thread of each sensor whose place on the robot is known a grid to write to. */
export function guardedSensors<Sensor extends { capture: CaptureOptions }>(
  sensors: readonly Sensor[],
  configuration: ObstacleGuardConfiguration,
): GuardedSensors<Sensor> {
  const { mode, clearanceM, heightM, dropM, blankIsMissing = false } = configuration;
  if (mode === 'off') return { sensors, grids: [], odometry: false };
  const grids: GuardedGrid[] = [];
  const guarded = sensors.map((sensor) => {
    const { source } = sensor.capture;
    const mount = mountOf(source);
    if (mount === null) return sensor;
    const common = { shape: GRID_SHAPE, odometry: hasOdometry(source), clearanceM, heightM, dropM };
    const gridOf = (looks?: string): SharedArrayBuffer => {
      const memory = makeSharedGrid(GRID_SHAPE);
      const grid = { sensor: sensor.capture.sensor, reader: new SharedGridReader(memory, GRID_SHAPE) };
      grids.push(looks === undefined ? grid : { ...grid, looks });
      return memory;
    };
    const clouds = { ...common, memory: gridOf(), mount, blankIsMissing };
    const floorCameras = source.kind === 'sim' && source.floorCameras === true ? SIM_FLOOR : [];
    const floor = floorCameras.map(({ looks, place }) => ({
      place,
      guard: { ...common, memory: gridOf(looks), mount: simMount(place), blankIsMissing },
    }));
    const guard = { clouds, floor };
    return { ...sensor, capture: { ...sensor.capture, guard } };
  });
  // A producer in shared memory may know no poses.
  const odometry = guarded.some(
    ({ capture: { source, guard } }) => guard !== undefined && source.kind !== 'shm' && hasOdometry(source),
  );
  return { sensors: guarded, grids, odometry };
}

/** The pose of a sensor's optical frame in base_link; `null` if nobody knows. */
export function mountOf(source: SourceOptions): Pose | null {
  if (source.kind === 'sim') return simMount({});
  if (source.kind === 'sim-lidar') {
    return opticalMount({ x: 0, y: 0, z: lidarHeight(source.index), roll: 0, pitch: 0, yaw: 0 });
  }
  return source.mount ?? null;
}

/** Where a simulated camera sits. */
function simMount(place: CameraOptions): Pose {
  const { forward: x, left: y, up: z, pitch, yaw } = { ...DEFAULT_CAMERA, ...place };
  return opticalMount({ x, y, z, roll: 0, pitch, yaw });
}

/** Whether the poses of a source's clouds say where the robot is. */
export function hasOdometry(source: SourceOptions): boolean {
  switch (source.kind) {
    case 'sim':
    case 'sim-lidar':
      return true;
    case 'ros':
      return source.topics.some(({ as }) => as === 'pose' || as === 'tf');
    case 'shm':
      return source.layout === 'farpoint';
    default:
      return false;
  }
}
