import type { Pose } from '@farpoint/protocol';
import type { Corner } from '@farpoint/safety';
import { DEFAULT_CAMERA } from '@farpoint/sim';
import type { SourceOptions } from '../capture/open-source.ts';
import { lidarHeight } from '../capture/sim-lidar-source.ts';
import type { CloudSensorOptions } from '../sensors/cloud-sensor.ts';
import type { GuardTopicsOptions } from './guard-topics-messages.ts';
import { opticalMount, type SensorMount } from './sensor-mount.ts';
import { type GridShape, makeSharedGrid, SharedGridReader } from './shared-grid.ts';

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
  /** Where the main sensor sits, if it is not simulated; `null`: not known. */
  mount: SensorMount | null;
  /** How hard the base brakes: m/s² and rad/s². */
  brakes: { linear: number; angular: number };
  /** The topics of the robot's ROS graph that bound its motion as well. */
  topics?: GuardTopicsOptions | null | undefined;
  /** Whether floor that a camera should see and does not counts as missing. */
  blankIsMissing?: boolean | undefined;
  /** Whether floor over which a laser scan passes counts as seen. */
  scansShowFloor?: boolean | undefined;
}

/** Around base_link: 4 m in each direction. */
export const GRID_SHAPE: GridShape = { side: 160, cellM: 0.05 };

/** The sensors with the guard's part of their capture threads, and its ends of their grids. */
export interface GuardedSensors {
  sensors: readonly CloudSensorOptions[];
  /** One for each guarded sensor; empty if the guard is off. */
  grids: readonly { sensor: number; reader: SharedGridReader }[];
}

/** Gives the capture thread of each sensor whose place on the robot is known a grid to write to. */
export function guardedSensors(
  sensors: readonly CloudSensorOptions[],
  configuration: ObstacleGuardConfiguration,
): GuardedSensors {
  const { mode, clearanceM, heightM, dropM, blankIsMissing = false } = configuration;
  if (mode === 'off') return { sensors, grids: [] };
  const grids: { sensor: number; reader: SharedGridReader }[] = [];
  const guarded = sensors.map((sensor) => {
    const { source } = sensor.capture;
    const mount = mountOf(source, configuration.mount);
    if (mount === null) return sensor;
    const memory = makeSharedGrid(GRID_SHAPE);
    grids.push({ sensor: sensor.capture.sensor, reader: new SharedGridReader(memory, GRID_SHAPE) });
    const odometry = hasOdometry(source);
    const band = { clearanceM, heightM, dropM, blankIsMissing };
    const guard = { memory, shape: GRID_SHAPE, mount, odometry, ...band };
    return { ...sensor, capture: { ...sensor.capture, guard } };
  });
  return { sensors: guarded, grids };
}

/** The pose of a sensor's optical frame in base_link; `null` if nobody knows. */
export function mountOf(source: SourceOptions, configured: SensorMount | null): Pose | null {
  if (source.kind === 'sim') {
    const { forward: x, left: y, up: z, pitch, yaw } = DEFAULT_CAMERA;
    return opticalMount({ x, y, z, roll: 0, pitch, yaw });
  }
  if (source.kind === 'sim-lidar') {
    return opticalMount({ x: 0, y: 0, z: lidarHeight(source.index), roll: 0, pitch: 0, yaw: 0 });
  }
  return configured === null ? null : opticalMount(configured);
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
