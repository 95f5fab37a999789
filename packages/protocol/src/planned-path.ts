/** The path that the robot's own navigator has planned: `path` on the `telemetry` channel. */
import * as z from 'zod/mini';

/** A longer path is told by its most telling points. */
export const MAX_PATH_POINTS = 128;
/** No place that is told is farther from the world's origin along an axis, metres. */
export const MAX_PLACE_M = 1_000_000;

/** The path that the robot's own navigator has planned. Whether the robot follows it, nobody says. */
export interface PlannedPath {
  type: 'path';
  /** The topic that it comes from. */
  topic: string;
  /** When the robot received it, by its monotonic clock, ms. */
  timeMs: number;
  /** Time since then, ms. */
  ageMs: number;
  /** x and y in the world, metres, from the robot to the goal; empty if there is no path any more. */
  points: [x: number, y: number][];
}

/** A coordinate in the world, metres. */
export const placeSchema = z.number().check(z.minimum(-MAX_PLACE_M), z.maximum(MAX_PLACE_M));
export const navigationTopicSchema = z.string().check(z.minLength(1), z.maxLength(255));

export const plannedPathSchema = z.strictObject({
  type: z.literal('path'),
  topic: navigationTopicSchema,
  timeMs: z.number().check(z.minimum(0)),
  ageMs: z.number().check(z.minimum(0)),
  points: z.array(z.tuple([placeSchema, placeSchema])).check(z.maxLength(MAX_PATH_POINTS)),
}) satisfies z.ZodMiniType<PlannedPath>;
