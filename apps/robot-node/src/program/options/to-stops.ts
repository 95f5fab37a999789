import { join } from 'node:path';
import type { GraphOptions } from '../../ground/ros/open-graph.ts';
import type { RobotStopsOptions } from '../../motion/stops/open-stops.ts';
import type { RobotOptionValues } from './robot-program.ts';
import { rosKindOf } from './ros-kind.ts';

/** @param graph the robot's graph of this kind */
export function toStops(
  values: RobotOptionValues,
  graph: (kind: GraphOptions['kind']) => GraphOptions,
): RobotStopsOptions {
  const { stopTopic: topic, stopShm, stopGpio, stopKey: key, stopSilenceMs: silentMs } = values;
  const kind = rosKindOf(values);
  const { shmFolder, shmOwner } = values;
  return {
    ...(topic === null || kind === null ? {} : { topic: { graph: graph(kind), topic, silentMs } }),
    ...(stopShm === null
      ? {}
      : { shm: { path: join(shmFolder, stopShm), owner: shmOwner ?? undefined, silentMs } }),
    ...(stopGpio === null ? {} : { gpio: stopGpio }),
    key,
  };
}
