/** Whether and how the robot drives back by itself when it hears no operator. */
import { defaultReturnOptions } from '@farpoint/safety';
import { defineOption, optionGroup, schema } from '@farpoint/service';
import * as z from 'zod';

const defaults = defaultReturnOptions;

export const returnOptions = optionGroup('return', {
  return: defineOption({
    schema: schema.boolean(),
    default: false,
    file: 'enabled',
    help: 'the robot drives back slowly along its own track after it has lost all operators, until it hears one again (docs/return.md)',
  }),
  returnAfterS: defineOption({
    schema: schema.number({ min: 5, max: 3600 }),
    default: defaults.afterMs / 1000,
    argument: 'SECONDS',
    file: 'afterS',
    help: 'it begins after no operator has been heard for this long; more than --lease-silence-s',
  }),
  returnAnnounceS: defineOption({
    schema: schema.number({ min: 1, max: 60 }),
    default: defaults.announceMs / 1000,
    argument: 'SECONDS',
    file: 'announceS',
    help: 'it says so for this long before it moves',
  }),
  returnMaxM: defineOption({
    schema: schema.number({ min: 0.5, max: 500 }),
    default: defaults.maxM,
    argument: 'METRES',
    file: 'maxM',
    help: 'it goes back no farther than this along its track',
  }),
  returnSpeed: defineOption({
    schema: schema.number({ min: 0.05, max: 0.5 }),
    default: defaults.maxLinear,
    argument: 'M/S',
    file: 'maxLinear',
    help: 'its highest speed on the way back',
  }),
  returnUnseen: defineOption({
    schema: schema.choice(['stop', 'slow']),
    default: defaults.unseen,
    argument: 'CHOICE',
    file: 'unseen',
    help: 'where no sensor sees the way back: stop (it waits), or slow (it goes on, and may run into somebody)',
  }),
  returnTopic: defineOption({
    schema: schema.optional(
      z
        .string('must be text')
        .regex(/^\/[A-Za-z_][\w/]{0,199}$/, 'must be a topic’s full name, as in /returning'),
    ),
    default: null,
    argument: 'TOPIC',
    file: 'topic',
    help: 'a topic of the robot’s ROS graph on which it publishes std_msgs/Bool: true while it says that it drives back, and while it does',
  }),
});
