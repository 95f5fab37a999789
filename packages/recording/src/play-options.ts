import type { CloudAxes } from '@farpoint/ros';

export interface PlayOptions {
  /** An MCAP file or a ROS 1 bag. */
  path: string;
  /** Topic of the clouds; `null` for the topic with most clouds. */
  topic: string | null;
  /** 1 for the recorded speed, 2 for twice as fast. */
  rate: number;
  /** Where to begin, s after the first message. */
  fromS: number;
  atEnd: 'repeat' | 'stop';
  /** `auto`: optical if the frame's name says so (REP-103), else body. */
  axes: CloudAxes | 'auto';
  /** Frame of the robot's base; by default as odometry and tf name it. */
  baseFrame?: string | null;
  /** Topics whose messages are delivered at their times along with the clouds; missing topics are ignored. */
  along?: readonly string[];
}
