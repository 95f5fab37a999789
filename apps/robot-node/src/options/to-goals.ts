import { topicAs } from '@farpoint/ros';
import type { GoalConfiguration } from '../goals/goal-configuration.ts';
import type { GraphOptions } from '../ros/open-graph.ts';
import { hasOdometry } from './odometry.ts';
import type { RobotOptionKey, RobotOptionValues } from './robot-program.ts';
import { rosKindOf } from './ros-kind.ts';

/**
 * What takes the robot's goals; undefined if it takes none.
 *
 * @param refuse takes what is wrong
 * @param graph the robot's graph of this kind
 */
export function toGoals(
  values: RobotOptionValues,
  refuse: (key: RobotOptionKey, detail: string) => void,
  graph: (kind: GraphOptions['kind']) => GraphOptions,
): GoalConfiguration | undefined {
  const { goals, goalsVelocityTopic: velocityTopic } = values;
  if (goals === 'off') return undefined;
  const shared = { mostM: values.goalsMaxM, navigatorSilentMs: values.goalsSilentMs };
  if (goals === 'sim') {
    if (values.source !== 'sim') refuse('goals', 'can be sim only with the source sim');
    return { ...shared, navigator: { kind: 'sim' } };
  }
  const kind = rosKindOf(values);
  if (kind === null) refuse('goals', 'needs a ROS graph: neither source nor sink is ROS');
  if (!hasOdometry(values))
    refuse('goals', 'needs odometry: ros1 or ros2 with a topic of nav_msgs/Odometry with `as: pose`');
  // The robot would follow itself.
  if (topicAs(values.topics, 'velocity')?.topic === velocityTopic)
    refuse('goalsVelocityTopic', 'must not be the topic on which the robot publishes its velocities');
  if (kind === null) return undefined;
  const { goalsTopic: goalTopic, goalsFrame: frame, goalsVelocityType } = values;
  const velocityType = `geometry_msgs/msg/${goalsVelocityType}`;
  return {
    ...shared,
    navigator: { kind: 'ros', graph: graph(kind), goalTopic, frame, velocityTopic, velocityType },
  };
}
