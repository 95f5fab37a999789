/**
 * The rings of a spinning LiDAR, as the robot knows them, on the `session` channel. Points carry no ring: a receiver
 * takes the one whose elevation is nearest to the point's, seen from the sensor.
 */
import * as z from 'zod/mini';
import { MAX_SENSORS } from './placement.ts';

/** No LiDAR has more. */
export const MAX_RINGS = 256;

/** Elevations of a sensor's rings. Sent after the welcome for each sensor whose rings are known, and at each change. */
export interface SensorRings {
  type: 'rings';
  /** Number of the sensor. */
  sensor: number;
  /** Radians above the horizontal plane of the sensor's own frame, each higher than the one before. */
  elevations: number[];
}

const isAscending = (values: readonly number[]) =>
  values.every((value, i) => i === 0 || value > values[i - 1]!);

export const sensorSchema = z.int().check(z.minimum(0), z.maximum(MAX_SENSORS - 1));

export const sensorRingsSchema = z.strictObject({
  type: z.literal('rings'),
  sensor: sensorSchema,
  elevations: z
    .array(z.number().check(z.minimum(-Math.PI / 2), z.maximum(Math.PI / 2)))
    .check(z.minLength(2), z.maxLength(MAX_RINGS), z.refine(isAscending, 'must ascend')),
}) satisfies z.ZodMiniType<SensorRings>;
