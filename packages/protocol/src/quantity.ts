/**
 * Numbers that the robot measures over time, such as a temperature or a latitude. The robot describes each of them once,
 * on the `session` channel; their samples come in batches on the `telemetry` channel.
 */
import * as z from 'zod/mini';
import { READING_LIMITS } from './reading.ts';

/** Quantities are numbered from 0. */
export const MAX_QUANTITIES = 64;
/** In one message, so that it stays within the channel's limit. */
export const MAX_SAMPLES = 64;
/** Lengths in UTF-16 units. */
export const QUANTITY_LIMITS = { field: 128, unit: 12 } as const;

/** Describes a number that the robot measures over time. */
export interface Quantity {
  type: 'quantity';
  /** By which samples name it in this session. */
  number: number;
  /** The topic that it is read from. */
  topic: string;
  /**
   * Its field in the topic's messages. Two quantities of one topic with the fields `latitude` and `longitude` are a
   * position on the earth (WGS 84).
   */
  field: string;
  /** For people. */
  label: string;
  /** As it is shown after a number; empty for a number without unit. */
  unit: string;
  /** Its samples are those of the recording that the robot plays. */
  recorded?: true | undefined;
}

/** A quantity's number, when the sample was taken relative to the message's time (ms, 0 or less), and its value. */
export type Sample = [quantity: number, offsetMs: number, value: number];

/** Samples of quantities. */
export interface Samples {
  type: 'samples';
  /** When the newest of them was taken, robot's monotonic clock, ms. */
  timeMs: number;
  /** Of each quantity, the oldest first. */
  samples: Sample[];
}

const number = z.int().check(z.minimum(0), z.maximum(MAX_QUANTITIES - 1));

export const quantitySchema = z.strictObject({
  type: z.literal('quantity'),
  number,
  topic: z.string().check(z.minLength(1), z.maxLength(READING_LIMITS.topic)),
  field: z.string().check(z.maxLength(QUANTITY_LIMITS.field)),
  label: z.string().check(z.minLength(1), z.maxLength(READING_LIMITS.label)),
  unit: z.string().check(z.maxLength(QUANTITY_LIMITS.unit)),
  recorded: z.optional(z.literal(true)),
}) satisfies z.ZodMiniType<Quantity>;

export const samplesSchema = z.strictObject({
  type: z.literal('samples'),
  timeMs: z.number().check(z.minimum(0)),
  samples: z
    .array(z.tuple([number, z.number().check(z.maximum(0)), z.number()]))
    .check(z.minLength(1), z.maxLength(MAX_SAMPLES)),
}) satisfies z.ZodMiniType<Samples>;
