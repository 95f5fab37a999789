/** The simulated robot. */
import { MAX_SENSORS } from '@farpoint/protocol';
import { defineOption, optionGroup, schema } from '@farpoint/service';
import type { EarthOrigin, Thing } from '@farpoint/sim';
import * as z from 'zod';

const earthOrigin = z
  .string('must be a latitude and a longitude such as 48.1374,11.5755')
  .transform((text, context): EarthOrigin => {
    const [, north, east] = /^(-?\d{1,2}(?:\.\d+)?), ?(-?\d{1,3}(?:\.\d+)?)$/.exec(text.trim()) ?? [];
    const [latitude, longitude] = [Number(north), Number(east)];
    if (Math.abs(latitude) <= 85 && Math.abs(longitude) <= 180) return { latitude, longitude };
    context.addIssue({
      code: 'custom',
      message: 'must be a latitude (-85 to 85) and a longitude (-180 to 180) such as 48.1374,11.5755',
    });
    return z.NEVER;
  });

/**
 * Nearer, it would stand in the robot, metres: the robot's radius, the guard's margin and half of a thing.
 */
const LEAST_THING_M = 0.55;
/** Things that can be put before the simulated robot. Chosen: a figure for a test; each costs every ray. */
const MOST_THINGS = 32;

const things = z.string('must be "ahead,left,height …" in metres').transform((text, context): Thing[] => {
  const read = text
    .trim()
    .split(/\s+/)
    .map((thing) => thing.split(',').map(Number));
  const valid = read.every(
    (numbers) =>
      numbers.length === 3 && numbers.every((n) => Math.abs(n) <= 20) && (numbers[2] as number) > 0,
  );
  if (!valid || read.length > MOST_THINGS) {
    context.addIssue({ code: 'custom', message: 'must be "ahead,left,height …" in metres' });
    return z.NEVER;
  }
  if (read.some(([ahead = 0, left = 0]) => Math.hypot(ahead, left) < LEAST_THING_M)) {
    context.addIssue({
      code: 'custom',
      message: `must be ${LEAST_THING_M} m or more from the robot’s start`,
    });
    return z.NEVER;
  }
  return read.map(([ahead = 0, left = 0, height = 0]) => ({ ahead, left, height }));
});

const place = z.string('must be "x,y" in metres').transform((text, context): { x: number; y: number } => {
  const [, x, y] = /^(-?\d{1,4}(?:\.\d+)?), ?(-?\d{1,4}(?:\.\d+)?)$/.exec(text.trim()) ?? [];
  if (x !== undefined && y !== undefined) return { x: Number(x), y: Number(y) };
  context.addIssue({ code: 'custom', message: 'must be "x,y" in metres' });
  return z.NEVER;
});

export const simOptions = optionGroup('source', {
  simSeed: defineOption({
    schema: schema.integer({ min: 0, max: 0xffffffff }),
    default: 1,
    argument: 'SEED',
    help: 'seed of the simulated robot’s sensor noise',
  }),
  simCharge: defineOption({
    schema: schema.number({ min: 0, max: 100 }),
    default: 95,
    argument: 'PERCENT',
    help: 'charge of the simulated robot’s battery at the start',
  }),
  simOrigin: defineOption({
    schema: schema.optional(earthOrigin),
    default: null,
    argument: 'LAT,LON',
    help: 'where on the earth the simulated building is, degrees, e.g. 48.1374,11.5755: the robot then has a satellite receiver',
  }),
  simLidars: defineOption({
    schema: schema.integer({ min: 0, max: MAX_SENSORS - 1 }),
    default: 0,
    argument: 'N',
    help: 'number of LiDARs of the simulated robot, in addition to its camera: 16 beams, 10 revolutions a second each',
  }),
  simThings: defineOption({
    schema: schema.optional(things),
    default: null,
    argument: 'PLACES',
    help: 'boxes of 0.3 × 0.3 m in the simulated building, by where the robot starts: "ahead,left,height …", metres',
  }),
  simPlanTo: defineOption({
    schema: schema.optional(place),
    default: null,
    argument: 'X,Y',
    help: 'the simulated robot has a map of its building and a plan to this place in it, as a navigator would publish them; metres',
  }),
  simCommands: defineOption({
    schema: schema.boolean(),
    default: false,
    help: 'the simulated robot has commands to try out: lights, a horn, and a self-test that takes a while (docs/commands.md)',
  }),
  simFloor: defineOption({
    schema: schema.choice(['seen', 'unseen']),
    default: 'seen',
    argument: 'CHOICE',
    help: 'floor at the wheels of the simulated robot: seen by two small cameras of the obstacle guard, or unseen, as by robots with nothing but a camera that looks ahead',
  }),
  simSize: defineOption({
    schema: schema.integer({ min: 16, max: 1024 }),
    default: 480,
    argument: 'PIXELS',
    help: 'width and height of the simulated camera, a multiple of 4',
  }),
});
