import type { DdsOptions } from '@farpoint/dds';
import type { RosGraph } from '@farpoint/ros';
import type { Ros1Options } from '@farpoint/ros/ros1';
import { monotonicMs } from '../clock.ts';

/** Which graph to take part in; plain data, so that it can be handed to a worker. */
export type GraphOptions = ({ kind: 'ros1' } & Ros1Options) | ({ kind: 'ros2' } & DdsOptions);

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
      // Its addon needs a library that not every robot has.
      const { DdsGraph } = await import('@farpoint/dds');
      const { kind: _, ...dds } = options;
      return new DdsGraph({ ...dds, now: monotonicMs });
    }
  }
}
