import type { GraphOptions } from '../ros/open-graph.ts';

/** A navigator in the robot's ROS graph. */
export interface RosNavigatorOptions {
  kind: 'ros';
  graph: GraphOptions;
  /** Where goals are published, geometry_msgs/PoseStamped. */
  goalTopic: string;
  /** The frame in which the robot's pose is told. */
  frame: string;
  /** Where the navigator publishes its velocities. */
  velocityTopic: string;
  /** `geometry_msgs/msg/Twist` or `geometry_msgs/msg/TwistStamped`. */
  velocityType: string;
}

/** What takes the robot's goals, as configured. */
export interface GoalConfiguration {
  /** Goals that are farther from the robot are refused, m. */
  mostM: number;
  /** A velocity of the navigator that is older counts as zero, ms. */
  navigatorSilentMs: number;
  navigator: { kind: 'sim' } | RosNavigatorOptions;
}
