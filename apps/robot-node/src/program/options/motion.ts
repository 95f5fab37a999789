/** How the robot's motion is bounded, and who may drive it for how long. */
import { afterGapChoices, estopReleasePolicies, MOST_RESUME_MS } from '@farpoint/protocol';
import { defaultDriveLimits, Footprint, RESUME_WITHIN_MS } from '@farpoint/safety';
import { defineOption, type OptionValues, optionGroup, schema } from '@farpoint/service';
import { FRESH_FRAME_MS } from '../../ground/outgoing-frame.ts';
import type { MotionLimits } from '../../motion/open-drive.ts';
import { footprintOf } from './guard.ts';

/** The safety limits, and how many operators may connect. */
export const limitsOptions = optionGroup('limits', {
  maxLinear: defineOption({
    schema: schema.number({ min: 0.01, max: 10 }),
    default: defaultDriveLimits.maxLinear,
    argument: 'M/S',
    help: 'maximum speed, m/s',
  }),
  maxLateral: defineOption({
    schema: schema.number({ min: 0, max: 10 }),
    default: 0,
    argument: 'M/S',
    help: 'maximum speed sideways, m/s, for a base that can (mecanum or omnidirectional wheels, legs); 0: it refuses to; for the simulated robot it also says whether its base can',
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

/**
 * A picture that is overdue by this much counts as old as `viewSlowMs`, ms. Chosen: links whose packets jitter by 100 ms slow
 * nobody down, and a frozen view is noticed before the robot has gone 20 cm at walking speed.
 */
const VIEW_STALL_MS = 150;

export const motionOptions = optionGroup('motion', {
  view: defineOption({
    schema: schema.choice(['required', 'optional']),
    default: 'required',
    argument: 'CHOICE',
    help: 'required: the robot moves only while its driver sees a fresh picture or cloud of it; optional: what the driver sees is not considered, for drivers who stand beside the robot',
  }),
  viewSlowMs: defineOption({
    schema: schema.number({ min: 50, max: 5000 }),
    default: FRESH_FRAME_MS,
    argument: 'MS',
    help: 'the robot is slower when what the driver sees is older than this, from the robot’s capture to its receipt of the command',
  }),
  viewBrakeMs: defineOption({
    schema: schema.number({ min: 100, max: 10_000 }),
    default: 400,
    argument: 'MS',
    help: 'the robot brakes when it is older than this',
  }),
  blindTravelM: defineOption({
    schema: schema.number({ min: 0.05, max: 10 }),
    default: 0.5,
    argument: 'METRES',
    help: 'the furthest that the robot goes between what the driver sees and standing still: bounds its speed',
  }),
  accelerationMps2: defineOption({
    schema: schema.number({ min: 0.1, max: 20 }),
    default: 1,
    argument: 'M/S2',
    help: 'acceleration',
  }),
  lateralAccelerationMps2: defineOption({
    schema: schema.optional(schema.number({ min: 0.1, max: 20 })),
    default: null,
    argument: 'M/S2',
    help: 'acceleration sideways; without it, as forwards',
  }),
  decelerationMps2: defineOption({
    schema: schema.number({ min: 0.1, max: 20 }),
    default: 2,
    argument: 'M/S2',
    help: 'deceleration that the base reaches on its floor: all stopping distances are computed with it',
  }),
  lateralDecelerationMps2: defineOption({
    schema: schema.optional(schema.number({ min: 0.1, max: 20 })),
    default: null,
    argument: 'M/S2',
    help: 'deceleration sideways, at least the other one; without it, as forwards. If the base brakes less hard sideways, set decelerationMps2 to what it reaches in every direction',
  }),
  emergencyMps2: defineOption({
    schema: schema.number({ min: 0.1, max: 100 }),
    default: 4,
    argument: 'M/S2',
    help: 'deceleration at an emergency stop, on silence, and for what is in the way; at least the other one',
  }),
  turnRadps2: defineOption({
    schema: schema.number({ min: 0.1, max: 100 }),
    default: 3,
    argument: 'RAD/S2',
    help: 'angular acceleration; twice that where the robot must stop',
  }),
});

export type MotionValues = OptionValues<typeof motionOptions> & { footprint: string };

/** @param refuse what contradicts something else */
export function toMotion(
  values: MotionValues,
  refuse: (key: keyof MotionValues, detail: string) => void,
): MotionLimits {
  const { viewSlowMs, viewBrakeMs, decelerationMps2, emergencyMps2, turnRadps2 } = values;
  if (viewBrakeMs <= viewSlowMs)
    refuse('viewBrakeMs', `must be above the age at which the robot is slower, ${viewSlowMs} ms`);
  if (emergencyMps2 < decelerationMps2)
    refuse('emergencyMps2', `must be at least the ordinary deceleration, ${decelerationMps2} m/s²`);
  const { lateralAccelerationMps2, lateralDecelerationMps2 } = values;
  if (lateralDecelerationMps2 !== null && lateralDecelerationMps2 < decelerationMps2)
    refuse('lateralDecelerationMps2', `must be at least the deceleration forwards, ${decelerationMps2} m/s²`);
  return {
    ramps: {
      ...(lateralAccelerationMps2 === null ? {} : { lateralAccelerationMps2 }),
      ...(lateralDecelerationMps2 === null ? {} : { lateralDecelerationMps2 }),
      accelerationMps2: values.accelerationMps2,
      decelerationMps2,
      emergencyMps2,
      turnRadps2,
      emergencyTurnRadps2: 2 * turnRadps2,
    },
    view:
      values.view === 'optional'
        ? null
        : {
            slowMs: viewSlowMs,
            brakeMs: viewBrakeMs,
            stallMs: VIEW_STALL_MS,
            mostM: values.blindTravelM,
            decelerationMps2,
            radiusM: new Footprint(footprintOf(values.footprint)).reach,
          },
  };
}
