/**
 * An `alarm` on the `session` channel: a quantity is outside the limits in the robot's configuration. The robot judges,
 * because it sees every sample, also while nobody is connected; all operators see the same verdict.
 */
import * as z from 'zod/mini';
import { QUANTITY_LIMITS } from './quantity.ts';
import { type ReadingLevel, readingLevels } from './reading.ts';

/** Alarms are numbered from 0. */
export const MAX_ALARMS = 32;
export const ALARM_TEXT_LENGTH = 120;

/** An alarm was raised, changed its level or was cleared. Those that are raised are also sent after the welcome. */
export interface Alarm {
  type: 'alarm';
  /** By which later messages name it. */
  number: number;
  /** `ok`: it is cleared. */
  level: ReadingLevel;
  /** What is wrong and what to do, for people. */
  text: string;
  /** The value that raised or cleared it. */
  value: number;
  /** The limit that the value crossed. */
  limit: number;
  /** Unit of the value and the limit. */
  unit: string;
  /** When it took this level, robot's monotonic clock, ms. */
  sinceMs: number;
  /** It is an alarm of the recording that the robot plays. */
  recorded?: true | undefined;
}

export const alarmSchema = z.strictObject({
  type: z.literal('alarm'),
  number: z.int().check(z.minimum(0), z.maximum(MAX_ALARMS - 1)),
  level: z.enum(readingLevels),
  text: z.string().check(z.minLength(1), z.maxLength(ALARM_TEXT_LENGTH)),
  value: z.number(),
  limit: z.number(),
  unit: z.string().check(z.maxLength(QUANTITY_LIMITS.unit)),
  sinceMs: z.number().check(z.minimum(0)),
  recorded: z.optional(z.literal(true)),
}) satisfies z.ZodMiniType<Alarm>;
