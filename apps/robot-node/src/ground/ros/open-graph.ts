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

/** Which graph to join. Plain data, so that it can be passed to a worker. */
export type GraphOptions = ({ kind: 'ros1' } & Ros1Options) | ({ kind: 'ros2' } & Ros2Options);

export interface Ros2Options extends DdsOptions {
  /** Default: `dds`. `auto`: rclnodejs if ROS is sourced and rclnodejs is installed. */
  graph?: Ros2Graph | 'auto';
  /** Prefix of the node's name, if it is a node. */
  name?: string;
}

/**
 * @param part the part of the robot that joins; it is added to the node's name
 * @throws {RosFault} saying what is missing and what helps
 */
export async function openGraph(
  options: GraphOptions,
  part: 'capture' | 'drive' | 'guard' | 'stop' | 'video' | 'return' | 'commands',
): Promise<RosGraph> {
  switch (options.kind) {
    case 'ros1': {
      // Loaded only when it is needed.
      const { openRos1Graph } = await import('@farpoint/ros/ros1');
      return openRos1Graph({ ...options, name: `${options.name}_${part}` }, monotonicMs);
    }
    case 'ros2': {
      const { kind: _, graph: __, name = 'farpoint', ...dds } = options;
      if (ros2GraphOf(options) === 'rclnodejs') {
        const entry = findRclnodejs() ?? '';
        return RclnodejsGraph.open({ ...dds, name: `${name}_${part}`, entry, now: monotonicMs });
      }
      // The addon needs a library that not every robot has.
      const { DdsGraph } = await import('@farpoint/dds');
      return new DdsGraph({ ...dds, now: monotonicMs });
    }
  }
}

/** @throws {RosFault} if a graph was requested by name and something is missing */
export function ros2GraphOf({ graph = 'dds', interface: network }: Ros2Options): Ros2Graph {
  const sourced = isSourced(process.env);
  return chooseRos2Graph(graph, {
    sourced,
    installed: sourced && findRclnodejs() !== null,
    needsDds: network !== undefined,
  });
}
/** Tells each fault of a graph once: a fault that repeats itself, unless another came between, says nothing new. */
export function tellNewFaults(graph: Pick<RosGraph, 'onFault'>, tell: (detail: string) => void): void {
  let last = '';
  graph.onFault = ({ message }) => {
    if (message !== last) tell(message);
    last = message;
  };
}
