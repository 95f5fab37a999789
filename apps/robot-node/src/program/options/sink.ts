/** Where velocities go. */

import { type TopicEntry, topicAs } from '@farpoint/ros';
import { defineOption, optionGroup, schema } from '@farpoint/service';
import type { GraphOptions } from '../../ground/ros/open-graph.ts';
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

const SINK_KINDS = ['source', 'shm', 'ros1', 'ros2'] as const;

export const sinkOptions = optionGroup('sink', {
  sink: defineOption({
    schema: schema.choice(SINK_KINDS),
    default: 'source',
    argument: 'KIND',
    file: 'kind',
    help: 'where velocities go: source (the simulator’s wheels), shm (the reference system’s command block), ros1 or ros2 (the topic with as: velocity)',
  }),
  shmAccess: defineOption({
    schema: schema.choice(['owner', 'group']),
    default: 'owner',
    argument: 'WHO',
    help: 'who may read and write the files that --sink shm creates: owner (0600), or group (0660)',
  }),
  shmReader: defineOption({
    schema: schema.choice(['auto', 'required']),
    default: 'auto',
    argument: 'WHEN',
    help: 'when motion needs a program that reads the velocities and answers: auto (once it has answered), or required (always)',
  }),
});
