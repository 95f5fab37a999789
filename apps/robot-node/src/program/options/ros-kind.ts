import type { GraphOptions } from '../../ground/ros/open-graph.ts';
import type { SINK_KINDS } from './sink.ts';
import type { SOURCE_KINDS } from './source.ts';

export interface RosKindValues {
  source: (typeof SOURCE_KINDS)[number];
  sink: (typeof SINK_KINDS)[number];
}

/** The ROS that the source or the sink uses; `null` if neither does. */
export function rosKindOf({ source, sink }: RosKindValues): GraphOptions['kind'] | null {
  for (const kind of [source, sink]) if (kind === 'ros1' || kind === 'ros2') return kind;
  return null;
}
