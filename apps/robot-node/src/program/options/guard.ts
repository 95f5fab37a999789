/** The obstacle guard: what the robot's own clouds say about its way. */
import { type Corner, defaultObstacleGuardOptions, Footprint, FootprintError } from '@farpoint/safety';
import { defineOption, type OptionValues, optionGroup, schema } from '@farpoint/service';
import * as z from 'zod';
import type { GuardTopicsOptions } from '../../motion/obstacles/guard-topics-messages.ts';
import type { ObstacleGuardConfiguration } from '../../motion/obstacles/guarded-sensors.ts';
import type { SensorMount } from '../../sense/sources/sensor-mount.ts';

/**
 * What a mount may say, metres and radians: as far as a footprint may reach (footprint.ts), and every
 * direction.
 */
const LIMITS = [10, 10, 10, Math.PI, Math.PI, Math.PI] as const;

/** Where a sensor sits on the robot, as text. */
export const mountSchema = z
  .string('must be "x,y,z,roll,pitch,yaw" in metres and radians')
  .transform((text, context): SensorMount => {
    const numbers = text.split(/[\s,]+/).map((part) => (part === '' ? Number.NaN : Number(part)));
    const [x, y, height, roll, pitch, yaw] = numbers;
    if (numbers.length === 6 && LIMITS.every((limit, i) => Math.abs(numbers[i] as number) <= limit)) {
      return { x, y, z: height, roll, pitch, yaw } as SensorMount;
    }
    context.addIssue({
      code: 'custom',
      message: 'must be "x,y,z,roll,pitch,yaw": up to 10 m and π rad, such as 0.12,0,0.9,0,0.2,0',
    });
    return z.NEVER;
  });

/** Default footprint, a disc, m: a small wheeled robot's, as the simulated one. */
const RADIUS = 0.25;

/** Stays text, as a configuration file has it. */
const footprintSchema = z.unknown().transform((given, context): string => {
  try {
    const text = String(given).trim();
    footprintOf(text);
    return text;
  } catch (error) {
    if (!(error instanceof FootprintError)) throw error;
    context.addIssue({ code: 'custom', message: error.message });
    return z.NEVER;
  }
});

/** The corners of a footprint that is valid. @throws {FootprintError} */
export function footprintOf(text: string): readonly Corner[] {
  const numbers = text.split(/[\s,;]+/).map((part) => (part === '' ? Number.NaN : Number(part)));
  const [radius = 0] = numbers;
  if (numbers.length === 1 && radius >= 0.05 && radius <= 5) return Footprint.disc(radius).corners;
  if (!numbers.every(Number.isFinite) || numbers.length < 6 || numbers.length % 2 !== 0) {
    throw new FootprintError(
      'must be a radius from 0.05 to 5 m, or corners "x,y x,y x,y …" in metres around base_link',
    );
  }
  const corners = Array.from({ length: numbers.length / 2 }, (_, i) => ({
    x: numbers[2 * i] as number,
    y: numbers[2 * i + 1] as number,
  }));
  return new Footprint(corners).corners;
}

export const guardOptions = optionGroup('guard', {
  obstacleGuard: defineOption({
    schema: schema.choice(['auto', 'on', 'off']),
    default: 'auto',
    argument: 'CHOICE',
    file: 'obstacles',
    help: 'whether the robot slows down and stops before what its clouds show on its way: on, off, auto (on if it is known where the sensor sits: simulated, or guard.mount)',
  }),
  footprint: defineOption({
    schema: footprintSchema,
    default: String(RADIUS),
    argument: 'SHAPE',
    help: 'the robot’s outline on the floor: a radius, or the corners of a convex polygon, "x,y x,y x,y …", in metres in base_link',
  }),
  guardMount: defineOption({
    schema: schema.optional(mountSchema),
    default: null,
    argument: 'POSE',
    file: 'mount',
    help: 'where the sensor sits in base_link: "x,y,z,roll,pitch,yaw", metres and radians, of its body frame (x forward, y left, z up); pitch is positive downwards',
  }),
  guardClearanceM: defineOption({
    schema: schema.number({ min: 0.005, max: 0.5 }),
    default: 0.04,
    argument: 'METRES',
    file: 'clearanceM',
    help: 'obstacles lower than this above the floor are ignored, m',
  }),
  guardHeightM: defineOption({
    schema: schema.number({ min: 0.1, max: 5 }),
    default: 1.1,
    argument: 'METRES',
    file: 'heightM',
    help: 'what is higher than this is passed under: the robot’s height and a margin',
  }),
  guardDropM: defineOption({
    schema: schema.number({ min: 0.02, max: 5 }),
    default: 0.15,
    argument: 'METRES',
    file: 'dropM',
    help: 'floor that lies deeper than this below the robot’s is a drop-off, m',
  }),
  guardBlankFloor: defineOption({
    schema: schema.choice(['missing', 'unseen']),
    default: 'missing',
    argument: 'CHOICE',
    file: 'blankFloor',
    help: 'what floor is of which a depth camera gives nothing, behind floor that it does see: missing (the robot brakes, as before a drop-off) or unseen (it is slow)',
  }),
  guardMarginM: defineOption({
    schema: schema.number({ min: 0.02, max: 1 }),
    default: defaultObstacleGuardOptions.marginM,
    argument: 'METRES',
    file: 'marginM',
    help: 'kept free around the footprint at walking speed; two thirds of it when creeping',
  }),
  guardUnseenMps: defineOption({
    schema: schema.number({ min: 0.05, max: 10 }),
    default: defaultObstacleGuardOptions.unseenMps,
    argument: 'M/S',
    file: 'unseenMps',
    help: 'highest speed towards where no sensor sees, and while a sensor is silent',
  }),
});

type GuardValues = OptionValues<typeof guardOptions> & {
  source: string;
  guardScanFloor: 'unseen' | 'seen';
  decelerationMps2: number;
  turnRadps2: number;
};

/** @param topics of a ROS graph that bound its motion too @param refuse what contradicts something else */
export function toObstacleGuard(
  values: GuardValues,
  topics: GuardTopicsOptions | null,
  refuse: (key: keyof GuardValues, detail: string) => void,
): ObstacleGuardConfiguration {
  const { obstacleGuard, source, guardMount, guardHeightM, guardClearanceM } = values;
  const sees = source === 'sim' || guardMount !== null || (topics?.scans.length ?? 0) > 0;
  if (obstacleGuard === 'on' && !sees)
    refuse('guardMount', 'is needed for the obstacle guard: it must know where the sensor sits');
  if (guardHeightM <= guardClearanceM) refuse('guardHeightM', 'must be above guard.clearanceM');
  return {
    mode: obstacleGuard,
    footprint: footprintOf(values.footprint),
    clearanceM: guardClearanceM,
    heightM: guardHeightM,
    dropM: values.guardDropM,
    marginM: values.guardMarginM,
    unseenMps: values.guardUnseenMps,
    topics,
    blankIsMissing: values.guardBlankFloor === 'missing',
    scansShowFloor: values.guardScanFloor === 'seen',
    brakes: { linear: values.decelerationMps2, angular: values.turnRadps2 },
  };
}
