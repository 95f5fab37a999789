/** The robot as a node of a ROS graph, for its source, its sink, or both. */
import { interfaceSchema, MOST_DOMAIN, machineSchema } from '@farpoint/dds';
import { topicTableSchema } from '@farpoint/ros';
import { defineOption, OptionsError, optionGroup, schema } from '@farpoint/service';
import * as z from 'zod';

const masterSchema = z.url({ protocol: /^http$/, error: 'must be an http:// address' });

export const rosOptions = optionGroup('ros', {
  rosName: defineOption({
    schema: schema.optional(
      z
        .string('must be text')
        .regex(/^[A-Za-z][A-Za-z0-9_]{0,100}$/, 'must be letters, digits and _, a letter first'),
    ),
    default: null,
    argument: 'NAME',
    file: 'name',
    help: 'ros1, rclnodejs: prefix of the robot’s node names; default: made from the id',
  }),
  rosGraph: defineOption({
    schema: schema.choice(['auto', 'dds', 'rclnodejs']),
    default: 'auto',
    argument: 'GRAPH',
    file: 'graph',
    help: 'ros2: dds (needs no ROS), rclnodejs (uses the sourced ROS installation and its middleware), or auto: rclnodejs if both are available, else dds',
  }),
  rosMaster: defineOption({
    schema: schema.optional(masterSchema),
    default: null,
    argument: 'URL',
    file: 'master',
    help: 'ros1: address of the master; default: ROS_MASTER_URI, or http://localhost:11311',
  }),
  rosHostname: defineOption({
    schema: schema.optional(schema.text({ max: 255 })),
    default: null,
    argument: 'HOST',
    file: 'hostname',
    help: 'ros1: name or address at which other nodes reach this machine; default: ROS_HOSTNAME, ROS_IP, or the machine’s name. With localhost, only nodes on this machine can connect',
  }),
  rosDomain: defineOption({
    schema: schema.optional(schema.integer({ min: 0, max: MOST_DOMAIN })),
    default: null,
    argument: 'NUMBER',
    file: 'domain',
    help: 'ros2: the domain; default: ROS_DOMAIN_ID, or 0',
  }),
  rosInterface: defineOption({
    schema: schema.optional(interfaceSchema),
    default: null,
    argument: 'NAME',
    file: 'interface',
    help: 'ros2: the network interface to use, by name or address; default: CycloneDDS chooses',
  }),
  rosPeers: defineOption({
    schema: schema.list(machineSchema),
    default: [],
    argument: 'HOSTS',
    file: 'peers',
    help: 'ros2: machines to look for where multicast does not reach, separated by commas; default: ROS_STATIC_PEERS',
  }),
  rosMessages: defineOption({
    schema: schema.list(schema.text()),
    default: [],
    argument: 'FOLDERS',
    file: 'messages',
    help: 'ros2: folders of packages with custom messages, <folder>/<package>/msg/<Type>.msg, separated by commas; packages of the sourced ROS are found without it',
  }),
  rosReach: defineOption({
    schema: schema.optional(schema.choice(['subnet', 'localhost'])),
    default: null,
    argument: 'REACH',
    file: 'reach',
    help: 'ros2: subnet, or localhost: only nodes on this machine; default: from ROS_LOCALHOST_ONLY and ROS_AUTOMATIC_DISCOVERY_RANGE, or subnet',
  }),
  rosBaseFrame: defineOption({
    schema: schema.optional(
      z
        .string('must be text')
        .max(255, 'must have at most 255 characters')
        .regex(/^\/?[^\s/]+(\/[^\s/]+)*$/, 'must be the name of a frame, such as robot1/base_link'),
    ),
    default: null,
    argument: 'FRAME',
    file: 'baseFrame',
    help: 'ros1, ros2, recording: frame of the robot’s base, whose pose counts; default: base_link or base_footprint in the tree of the frame that odometry positions, else that frame',
  }),
});

/** The address of the ROS 1 master. @throws {OptionsError} if the variable is none */
export function rosMasterUrl(rosMaster: string | null, env: NodeJS.ProcessEnv): string {
  const url = rosMaster ?? (env.ROS_MASTER_URI || 'http://localhost:11311');
  if (masterSchema.safeParse(url).success) return url;
  const detail = `must be an http:// address, as in http://localhost:11311, not ${JSON.stringify(url)}`;
  throw new OptionsError('ROS_MASTER_URI', detail);
}

/** The ROS topics that the robot may use. They can be set only in the configuration file. */
export const topicsOptions = {
  topics: defineOption({
    schema: topicTableSchema,
    default: [],
    flag: false,
    env: false,
    help: 'ros1, ros2: the only topics that the robot subscribes and publishes; recording: the topics of pictures and readings to show beside the clouds',
  }),
};
