/** What keeps the robot safe, and who may drive. */
import { defaultDriveLimits } from '@farpoint/safety';
import { defineOption, optionGroup, schema } from '@farpoint/service';

export const limitsOptions = optionGroup('limits', {
  maxLinear: defineOption({
    schema: schema.number({ min: 0.01, max: 10 }),
    default: defaultDriveLimits.maxLinear,
    argument: 'M/S',
    help: 'speed limit, m/s',
  }),
  maxAngular: defineOption({
    schema: schema.number({ min: 0.01, max: 10 }),
    default: defaultDriveLimits.maxAngular,
    argument: 'RAD/S',
    help: 'turning limit, rad/s',
  }),
  watchdogMs: defineOption({
    schema: schema.number({ min: 50, max: 1000 }),
    default: defaultDriveLimits.watchdogMs,
    argument: 'MS',
    help: 'without a fresh command for this long the robot stops',
  }),
  maxCommandsPerSecond: defineOption({
    schema: schema.number({ min: 10, max: 1000 }),
    default: defaultDriveLimits.maxCommandsPerSecond,
    argument: 'N',
    help: 'more commands a second are refused',
  }),
  takePolicy: defineOption({
    schema: schema.choice(['never', 'idle', 'always']),
    default: 'idle',
    argument: 'POLICY',
    help: 'may another operator take over: never, idle (where nothing has moved for 5 s), always',
  }),
  maxOperators: defineOption({
    schema: schema.integer({ min: 1, max: 32 }),
    default: 4,
    argument: 'N',
    help: 'operators at once, the one who drives included',
  }),
  silenceS: defineOption({
    schema: schema.number({ min: 1, max: 300 }),
    default: 60,
    argument: 'SECONDS',
    help: 'an operator of whom nothing is heard for this long is gone; after 5 s of it another may drive',
  }),
});
