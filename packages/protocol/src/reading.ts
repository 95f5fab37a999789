/**
 * A `reading` on the `telemetry` channel: what a sensor or a topic of the robot reports, as short text for people. The
 * newest reading of each topic is repeated every few seconds, so losing one does no harm.
 */
import * as z from 'zod/mini';

export const readingLevels = ['ok', 'warn', 'error'] as const;
/**
 * Whether people should look at a reading.
 *
 * @useDeclaredType
 */
export type ReadingLevel = (typeof readingLevels)[number];

/**
 * Shares of a battery's charge below which its level is `warn` and `error`. Chosen: a warning while
 * the robot can still drive back to its charger, and an error before it stops by itself.
 */
export const LOW_CHARGE = 0.2;
export const EMPTY_CHARGE = 0.1;

/** Lengths in UTF-16 units; together they keep the longest reading within a telemetry message. */
export const READING_LIMITS = { topic: 255, label: 40, values: 10, name: 36, text: 60 } as const;

/** What a sensor or a topic of the robot says, as short text for people. */
export interface Reading {
  type: 'reading';
  /** Identifies the reading. */
  topic: string;
  /** Label shown next to the values. */
  label: string;
  /** Whether people should look at it. */
  level: ReadingLevel;
  /** Name and value, most important first; a name may be empty. */
  values: [string, string][];
  /** Time since the robot received it, ms. */
  ageMs: number;
  /** When the robot received it, by its monotonic clock, ms. Robots before version 0.2 leave it out. */
  timeMs?: number | undefined;
}

const { topic, label, values, name, text } = READING_LIMITS;

export const readingSchema = z.strictObject({
  type: z.literal('reading'),
  topic: z.string().check(z.minLength(1), z.maxLength(topic)),
  label: z.string().check(z.minLength(1), z.maxLength(label)),
  level: z.enum(readingLevels),
  values: z
    .array(z.tuple([z.string().check(z.maxLength(name)), z.string().check(z.maxLength(text))]))
    .check(z.maxLength(values)),
  ageMs: z.number().check(z.minimum(0)),
  timeMs: z.optional(z.number().check(z.minimum(0))),
}) satisfies z.ZodMiniType<Reading>;
