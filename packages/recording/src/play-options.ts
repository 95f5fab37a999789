import type { CloudAxes } from '@farpoint/ros';

export interface PlayOptions {
  /** An MCAP file or a ROS 1 bag. */
  path: string;
  /** Of the clouds; `null`: the topic with most clouds. */
  topic: string | null;
  /** 1 as it was recorded, 2 twice as fast. */
  rate: number;
  /** Where to begin, s after the first message. */
  fromS: number;
  atEnd: 'repeat' | 'stop';
  /** `auto`: optical where the frame's name says so (REP-103), else body. */
  axes: CloudAxes | 'auto';
  /** Topics whose messages are told at their times, beside the clouds; those that are not there are passed over. */
  along?: readonly string[];
}
