import { type TopicEntry, topicAs } from '@farpoint/ros';
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

/** Whether the robot is told its pose and its velocity, and when they were measured. */
export function configuresOdometry(source: RosKindValues['source'], topics: readonly TopicEntry[]): boolean {
  if (source === 'sim') return true;
  const type = topicAs(topics, 'pose')?.type ?? '';
  return (source === 'ros1' || source === 'ros2') && /^nav_msgs\/(msg\/)?Odometry$/.test(type);
}
