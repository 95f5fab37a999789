import type { DdsOptions } from '@farpoint/dds';
import type { RosGraph } from '@farpoint/ros';
import {
  chooseRos2Graph,
  findRclnodejs,
  isSourced,
  RclnodejsGraph,
  type Ros2Graph,
} from '@farpoint/ros/rclnodejs';
import type { Ros1Options } from '@farpoint/ros/ros1';
import { monotonicMs } from '../clock.ts';

/** Which graph to take part in; plain data, so that it can be handed to a worker. */
export type GraphOptions = ({ kind: 'ros1' } & Ros1Options) | ({ kind: 'ros2' } & Ros2Options);

export interface Ros2Options extends DdsOptions {
  /** Left out: `dds`. `auto`: rclnodejs where ROS is sourced and it is installed. */
  graph?: Ros2Graph | 'auto';
  /** Begin of the node's name, where it is one. */
  name?: string;
}

/**
 * @param part what of the robot takes part: it makes the node’s name
 * @throws {RosFault} saying what is missing and what helps
 */
export async function openGraph(options: GraphOptions, part: 'capture' | 'drive'): Promise<RosGraph> {
  switch (options.kind) {
    case 'ros1': {
      // Only who needs it waits for it.
      const { openRos1Graph } = await import('@farpoint/ros/ros1');
      return openRos1Graph({ ...options, name: `${options.name}_${part}` }, monotonicMs);
    }
    case 'ros2': {
      const { kind: _, graph: __, name = 'farpoint', ...dds } = options;
      if (ros2GraphOf(options) === 'rclnodejs') {
        const entry = findRclnodejs() ?? '';
        return RclnodejsGraph.open({ ...dds, name: `${name}_${part}`, entry, now: monotonicMs });
      }
      // Its addon needs a library that not every robot has.
      const { DdsGraph } = await import('@farpoint/dds');
      return new DdsGraph({ ...dds, now: monotonicMs });
    }
  }
}

/** @throws {RosFault} it was asked for by name, and something is missing */
export function ros2GraphOf({ graph = 'dds', interface: network }: Ros2Options): Ros2Graph {
  const sourced = isSourced(process.env);
  return chooseRos2Graph(graph, {
    ...{ sourced, installed: sourced && findRclnodejs() !== null, needsDds: network !== undefined },
  });
}
