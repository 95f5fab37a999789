/** The robot as a node of a ROS graph: its source’s, its sink’s, or both. */
import { interfaceSchema, MOST_DOMAIN, machineSchema } from '@farpoint/dds';
import { defineOption, optionGroup, schema } from '@farpoint/service';
import * as z from 'zod';

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
    help: 'ros1, rclnodejs: begin of the names of its nodes; left out, made of the id',
  }),
  rosGraph: defineOption({
    schema: schema.choice(['auto', 'dds', 'rclnodejs']),
    default: 'auto',
    argument: 'GRAPH',
    file: 'graph',
    help: 'ros2: dds, which needs no ROS; rclnodejs, with the ROS installation that is sourced and its middleware; auto: rclnodejs where both are there, else dds',
  }),
  rosMaster: defineOption({
    schema: schema.optional(z.url({ protocol: /^http$/, error: 'must be an http:// address' })),
    default: null,
    argument: 'URL',
    file: 'master',
    help: 'ros1: the master; left out, ROS_MASTER_URI, or http://localhost:11311',
  }),
  rosHostname: defineOption({
    schema: schema.optional(schema.text({ max: 255 })),
    default: null,
    argument: 'HOST',
    file: 'hostname',
    help: 'ros1: how other nodes reach this machine; left out, ROS_HOSTNAME, ROS_IP, or its name. With localhost, only nodes of this machine can',
  }),
  rosDomain: defineOption({
    schema: schema.optional(schema.integer({ min: 0, max: MOST_DOMAIN })),
    default: null,
    argument: 'NUMBER',
    file: 'domain',
    help: 'ros2: the domain; left out, ROS_DOMAIN_ID, or 0',
  }),
  rosInterface: defineOption({
    schema: schema.optional(interfaceSchema),
    default: null,
    argument: 'NAME',
    file: 'interface',
    help: 'ros2: the network interface to use, by name or address; left out, CycloneDDS chooses',
  }),
  rosPeers: defineOption({
    schema: schema.list(machineSchema),
    default: [],
    argument: 'HOSTS',
    file: 'peers',
    help: 'ros2: machines to look for where multicast does not reach, with commas between them; left out, ROS_STATIC_PEERS',
  }),
  rosMessages: defineOption({
    schema: schema.list(schema.text()),
    default: [],
    argument: 'FOLDERS',
    file: 'messages',
    help: 'ros2: folders of packages whose messages are not ROS’s own, <folder>/<package>/msg/<Type>.msg, with commas between them; those of the ROS that is sourced are known',
  }),
  rosReach: defineOption({
    schema: schema.optional(schema.choice(['subnet', 'localhost'])),
    default: null,
    argument: 'REACH',
    file: 'reach',
    help: 'ros2: localhost: nodes of this machine alone; left out, as ROS_LOCALHOST_ONLY and ROS_AUTOMATIC_DISCOVERY_RANGE say, or subnet',
  }),
  rosAxes: defineOption({
    schema: schema.choice(['auto', 'optical', 'body']),
    default: 'auto',
    argument: 'AXES',
    file: 'axes',
    help: 'ros1, ros2: axes of the clouds’ frame: optical (z forward), body (x forward, z up), or auto: optical where its name says so',
  }),
  rosWaitS: defineOption({
    schema: schema.number({ min: 0, max: 3600 }),
    default: 30,
    argument: 'SECONDS',
    file: 'waitS',
    help: 'ros1, ros2: how long to wait for the first cloud at the start',
  }),
});
