import type { TopicEntry } from '@farpoint/ros';
import type { CloudSensorOptions } from '../../send/clouds/cloud-sensor.ts';
import type { CaptureOptions } from '../../sense/capture/capture-messages.ts';
import type { SourceOptions } from '../../sense/sources/open-source.ts';
import { opticalMount, type SensorMount } from '../../sense/sources/sensor-mount.ts';
import { cloudTrigger } from './check-videos.ts';
import type { RobotOptionValues } from './robot-program.ts';
import { toGraph } from './to-graph.ts';

/** Paper, equation 1: keeps the weight of points at distance 0 finite. */
const SAMPLING_EPSILON = 1e-6;
/** Paper, equation 3: the share of the raw cloud that is sent each second at any rate. */
const FLOOR_FRACTION = 0.1;
/** If not configured. A recording has its own rate, which is kept. */
const DEFAULT_FPS: Partial<Record<RobotOptionValues['source'], number>> = { sim: 60, recording: 120 };

/** The highest rate asked of the source of clouds, 1/s. */
export function framesPerS({ fps, source }: RobotOptionValues): number {
  return fps ?? DEFAULT_FPS[source] ?? 30;
}

/** How long a robot waits at its start for the first cloud, ms: a producer on the same machine is there sooner than a graph. */
export function waitMsOf({ waitS, source }: RobotOptionValues): number {
  return 1000 * (waitS ?? (source === 'shm' ? 10 : 30));
}

/** The main source of clouds comes first. */
export function toSensors(values: RobotOptionValues, topics: TopicEntry[]): CloudSensorOptions[] {
  const capture: CaptureOptions = {
    sensor: 0,
    source: mounted(toSource(values, topics), values.guardMount),
    framesPerSecond: framesPerS(values),
    plan: values.plan,
    sampling: { lambda: values.lambda, epsilon: SAMPLING_EPSILON, nearDistance: values.priorityDistance },
    floorFraction: FLOOR_FRACTION,
    mostPoints: values.maxPoints,
    picturesOfCloud: values.picturesOfCloud,
  };
  const main: CloudSensorOptions = { name: 'Camera', capture, priority: 0, weight: 1 };
  if (values.source !== 'sim') return [main];
  const lidars = Array.from({ length: values.simLidars }, (_, index): CloudSensorOptions => {
    const source: SourceOptions = { kind: 'sim-lidar', seed: values.simSeed, index };
    const lidar: CaptureOptions = { ...capture, sensor: index + 1, source, picturesOfCloud: false };
    return { name: index === 0 ? 'LiDAR' : `LiDAR ${index + 1}`, capture: lidar, priority: 1, weight: 1 };
  });
  return [main, ...lidars];
}

/** The simulated robot knows by itself where its sensors sit. */
function mounted(source: SourceOptions, mount: SensorMount | null): SourceOptions {
  const isSimulated = source.kind === 'sim' || source.kind === 'sim-lidar';
  return isSimulated || mount === null ? source : { ...source, mount: opticalMount(mount) };
}

function toSource(values: RobotOptionValues, topics: TopicEntry[]): SourceOptions {
  const path = values.path ?? '';
  switch (values.source) {
    case 'sim':
      return {
        kind: 'sim',
        seed: values.simSeed,
        size: values.simSize,
        floorCameras: values.simFloor === 'seen',
        triggerPerS: cloudTrigger(values.videos, framesPerS(values)),
      };
    case 'shm':
      return {
        kind: 'shm',
        layout: values.shmLayout,
        folder: values.shmFolder,
        owner: values.shmOwner ?? undefined,
        waitMs: waitMsOf(values),
      };
    case 'recording':
      return {
        kind: 'recording',
        path,
        topic: values.topic,
        rate: values.playRate,
        fromS: values.playFromS,
        atEnd: values.playEnd,
        axes: values.axes,
        topics,
        videos: values.playBeside === 'all' || values.playBeside === 'videos',
        telemetry: values.playBeside === 'all' || values.playBeside === 'telemetry',
        baseFrame: values.rosBaseFrame,
      };
    case 'ros1':
    case 'ros2':
      return {
        kind: 'ros',
        graph: toGraph(values, values.source),
        topics,
        axes: values.axes,
        baseFrame: values.rosBaseFrame,
        waitMs: waitMsOf(values),
      };
    case 'pcd':
      return { kind: 'pcd', path, frame: values.axes };
    case 'rgbd':
      return { kind: 'rgbd', path };
  }
}
