/** Where the robot may go. */
import { defaultGeofenceOptions, type EarthOrigin } from '@farpoint/safety';
import { defineOption, optionGroup, schema } from '@farpoint/service';
import * as z from 'zod';

const MESSAGE =
  'must be latitude and longitude in degrees, and perhaps the direction of x, as in 48.1374,11.5755,90';
const origin: z.ZodType<EarthOrigin | null> = z.unknown().transform((value, context) => {
  if (value === null) return null;
  const parts = typeof value === 'string' ? value.split(',').map((part) => part.trim()) : [];
  const [latitude, longitude, turnDeg = 0] = parts.map((part) => (part === '' ? Number.NaN : Number(part)));
  const isRight = (each: number | undefined, most: number) => each !== undefined && Math.abs(each) <= most;
  if (
    (parts.length === 2 || parts.length === 3) &&
    isRight(latitude, 85) &&
    isRight(longitude, 180) &&
    isRight(turnDeg, 360)
  )
    return { latitude: latitude ?? 0, longitude: longitude ?? 0, turnDeg };
  context.addIssue({ code: 'custom', message: MESSAGE });
  return z.NEVER;
});

const defaults = defaultGeofenceOptions;

export const fenceOptions = optionGroup('fence', {
  fence: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'FILE',
    file: 'file',
    help: 'areas in which the robot may go, may go slowly, or may not go: a GeoJSON file (docs/geofence.md)',
  }),
  fenceRadiusM: defineOption({
    schema: schema.optional(schema.number({ min: 1, max: 10_000 })),
    default: null,
    argument: 'M',
    file: 'radiusM',
    help: 'the robot may go no farther than this from the world’s origin, m',
  }),
  fenceOrigin: defineOption({
    schema: origin,
    default: null,
    argument: 'LAT,LON[,DEG]',
    file: 'origin',
    help: 'where the world’s origin is on the earth, degrees, and the direction of its x axis, degrees anticlockwise from east (0); for a fence with positions on the earth. Default: --sim-origin; with --fence-position fix, the first position of the file',
  }),
  fencePosition: defineOption({
    schema: schema.choice(['odometry', 'fix']),
    default: 'odometry',
    argument: 'WHAT',
    file: 'position',
    help: 'what says where the robot is: odometry (its pose in the world), or fix (its satellite receiver, which knows no direction)',
  }),
  fenceErrorM: defineOption({
    schema: schema.number({ min: 0, max: 100 }),
    default: 0.1,
    argument: 'M',
    file: 'errorM',
    help: 'how far off the position may be, m; the robot stays that much farther inside',
  }),
  fenceMaxAgeMs: defineOption({
    schema: schema.number({ min: 50, max: 10_000 }),
    default: defaults.maxAgeMs,
    argument: 'MS',
    file: 'maxAgeMs',
    help: 'the robot stands if its position is older than this, ms',
  }),
});
