import { topicAs } from '@farpoint/ros';
import type { RobotOptionValues } from './robot-program.ts';

/** Whether the robot is told its pose and its velocity, and when they were measured. */
export function hasOdometry({ source, topics }: Pick<RobotOptionValues, 'source' | 'topics'>): boolean {
  if (source === 'sim') return true;
  const type = topicAs(topics, 'pose')?.type ?? '';
  return (source === 'ros1' || source === 'ros2') && /^nav_msgs\/(msg\/)?Odometry$/.test(type);
}
