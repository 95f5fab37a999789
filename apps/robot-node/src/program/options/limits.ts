/** The safety limits, and how many operators may connect. */
import { afterGapChoices, MOST_RESUME_MS } from '@farpoint/protocol';
import { defaultDriveLimits, estopReleasePolicies, RESUME_WITHIN_MS } from '@farpoint/safety';
import { defineOption, optionGroup, schema } from '@farpoint/service';

export const limitsOptions = optionGroup('limits', {
  maxLinear: defineOption({
    schema: schema.number({ min: 0.01, max: 10 }),
    default: defaultDriveLimits.maxLinear,
    argument: 'M/S',
    help: 'maximum speed, m/s',
  }),
  maxAngular: defineOption({
    schema: schema.number({ min: 0.01, max: 10 }),
    default: defaultDriveLimits.maxAngular,
    argument: 'RAD/S',
    help: 'maximum turning rate, rad/s',
  }),
  watchdogMs: defineOption({
    schema: schema.number({ min: 50, max: 1000 }),
    default: defaultDriveLimits.watchdogMs,
    argument: 'MS',
    help: 'the robot stops after this long without a fresh command',
  }),
  takePolicy: defineOption({
    schema: schema.choice(['never', 'idle', 'always']),
    default: 'idle',
    argument: 'POLICY',
    help: 'when another operator may take over: never, idle (nothing has moved for 5 s), always',
  }),
  estopRelease: defineOption({
    schema: schema.choice(estopReleasePolicies),
    default: 'driver',
    argument: 'POLICY',
    help: 'who may release an emergency stop that an operator has latched: driver (whoever drives), latcher (that operator, while it drives), supervisor; supervisors always may',
  }),
  afterGap: defineOption({
    schema: schema.choice(afterGapChoices),
    default: 'let-go',
    argument: 'CHOICE',
    help: 'when commands come again after a gap that stopped the robot: let-go (it moves once the operator has let go of the grip, unless the gap was shorter than --resume-within-ms), resume (it moves at once, if the gap was shorter than 1 s)',
  }),
  resumeWithinMs: defineOption({
    schema: schema.number({ min: 0, max: MOST_RESUME_MS }),
    default: RESUME_WITHIN_MS,
    argument: 'MS',
    help: 'a hand that has held on through a shorter gap need not let go: the robot brakes, and moves on by its ramps; 0: it always must',
  }),
  maxOperators: defineOption({
    schema: schema.integer({ min: 1, max: 32 }),
    default: 4,
    argument: 'N',
    help: 'maximum operators at once, including the one who drives; grants for one subject get at most half of the places',
  }),
  silenceS: defineOption({
    schema: schema.number({ min: 1, max: 300 }),
    default: 60,
    argument: 'SECONDS',
    help: 'an operator who has been silent for this long is disconnected',
  }),
  leaseSilenceS: defineOption({
    schema: schema.number({ min: 0.5, max: 60 }),
    default: 3,
    argument: 'SECONDS',
    help: 'a driver whose page has sent nothing for this long loses control, and another may drive',
  }),
});
