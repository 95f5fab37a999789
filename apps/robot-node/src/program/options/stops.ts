/** Stops at the robot itself, which nobody but the robot's side releases. */
import type { GpioLineAt } from '@farpoint/gpio';
import { defineOption, optionGroup, schema } from '@farpoint/service';
import * as z from 'zod';

const GPIO = /^(?:\/dev\/)?(gpiochip\d{1,3}):(\d{1,4})(:active-low)?$/;
const gpioLine: z.ZodType<GpioLineAt | null> = z.unknown().transform((value, context) => {
  if (value === null) return null;
  const [, chip, line, low] = (typeof value === 'string' ? GPIO.exec(value) : null) ?? [];
  if (chip !== undefined) return { chip: `/dev/${chip}`, line: Number(line), activeLow: low !== undefined };
  context.addIssue({
    code: 'custom',
    message: 'must be CHIP:LINE or CHIP:LINE:active-low, as in gpiochip0:17',
  });
  return z.NEVER;
});

export const stopsOptions = optionGroup('stops', {
  stopTopic: defineOption({
    schema: schema.optional(
      z.string('must be text').regex(/^\/[A-Za-z_][\w/]{0,199}$/, 'must be a topic’s full name, as in /stop'),
    ),
    default: null,
    argument: 'TOPIC',
    file: 'topic',
    help: 'a topic of the robot’s ROS graph with std_msgs/Bool: true, silence and a publisher that is gone stop the robot, and only the topic releases it',
  }),
  stopShm: defineOption({
    schema: schema.optional(
      z.string('must be text').regex(/^[A-Za-z0-9_][\w.-]{0,63}$/, 'must be a file’s name without a folder'),
    ),
    default: null,
    argument: 'NAME',
    file: 'shm',
    help: 'a file in --shm-folder with a stop byte and a counter, written by another program: a stop byte other than 0, and a counter that stands still, stop the robot',
  }),
  stopGpio: defineOption({
    schema: gpioLine,
    default: null,
    argument: 'CHIP:LINE[:active-low]',
    file: 'gpio',
    help: 'a GPIO line, as in gpiochip0:17: while it is active or cannot be read, the robot is stopped',
  }),
  stopKey: defineOption({
    schema: schema.boolean(),
    default: false,
    file: 'key',
    help: 'every key on the robot’s console stops it; typing release and Enter releases it',
  }),
  stopSilenceMs: defineOption({
    schema: schema.number({ min: 100, max: 10_000 }),
    default: 500,
    argument: 'MS',
    file: 'silenceMs',
    help: '--stop-topic, --stop-shm and --guard-collision-topic: silent after this long without a sign of life, which stops the robot (a collision topic: see --guard-collision-silent)',
  }),
});
