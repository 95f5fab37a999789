/** The ROS topics that the robot may use. They can be set only in the configuration file. */
import { topicTableSchema } from '@farpoint/ros';
import { defineOption } from '@farpoint/service';

export const topicsOptions = {
  topics: defineOption({
    schema: topicTableSchema,
    default: [],
    flag: false,
    env: false,
    help: 'ros1, ros2: the only topics that the robot subscribes and publishes; recording: the topics of pictures and readings to show beside the clouds',
  }),
};
