/** Whether the robot drives to places that its driver names, and by which navigator. */
import { defaultGuidedOptions } from '@farpoint/safety';
import { defineOption, optionGroup, schema } from '@farpoint/service';
import * as z from 'zod';

const topic = z
  .string('must be text')
  .regex(/^\/[A-Za-z_][\w/]{0,199}$/, 'must be a topic’s full name, as in /goal_pose');

export const goalsOptions = optionGroup('goals', {
  goals: defineOption({
    schema: schema.choice(['off', 'ros', 'sim']),
    default: 'off',
    argument: 'NAVIGATOR',
    file: 'navigator',
    help: 'what leads the robot to the places that its driver clicks on: off (nothing), ros (a navigator in the robot’s ROS graph, such as Nav2), or sim (the simulated robot’s own) (docs/goals.md)',
  }),
  goalsMaxM: defineOption({
    schema: schema.number({ min: 0.5, max: 500 }),
    default: defaultGuidedOptions.mostM,
    argument: 'METRES',
    file: 'maxM',
    help: 'goals that are farther from the robot are refused',
  }),
  goalsTopic: defineOption({
    schema: topic,
    default: '/goal_pose',
    argument: 'TOPIC',
    file: 'topic',
    help: 'ros: where goals are published, geometry_msgs/PoseStamped',
  }),
  goalsFrame: defineOption({
    schema: z
      .string('must be text')
      .regex(/^[A-Za-z_][\w/-]{0,199}$/, 'must be the name of a frame, as in odom'),
    default: 'odom',
    argument: 'FRAME',
    file: 'frame',
    help: 'ros: the frame of the goals, which must be that of the robot’s odometry: odom, or map',
  }),
  goalsVelocityTopic: defineOption({
    schema: topic,
    default: '/cmd_vel_nav',
    argument: 'TOPIC',
    file: 'velocityTopic',
    help: 'ros: where the navigator publishes its velocities; never the topic on which the robot publishes',
  }),
  goalsVelocityType: defineOption({
    schema: schema.choice(['Twist', 'TwistStamped']),
    default: 'Twist',
    argument: 'TYPE',
    file: 'velocityType',
    help: 'ros: the type of these velocities, of geometry_msgs',
  }),
  goalsSilentMs: defineOption({
    schema: schema.number({ min: 50, max: 2000 }),
    default: defaultGuidedOptions.navigatorSilentMs,
    argument: 'MS',
    file: 'silentMs',
    help: 'a velocity of the navigator that is older counts as zero',
  }),
});
