/**
 * `diagnostics` on the `telemetry` channel: what the robot's components report about themselves. A message has only some
 * of the reports, those that have changed first; the others take turns.
 */
import * as z from 'zod/mini';
import { READING_LIMITS } from './reading.ts';

/** The most urgent first. */
export const diagnosticLevels = ['error', 'warn', 'stale', 'ok'] as const;
/**
 * How a component is. `stale`: it has reported nothing for a while.
 *
 * @useDeclaredType
 */
export type DiagnosticLevel = (typeof diagnosticLevels)[number];

/** Lengths in UTF-16 units; together they keep the message within the channel's limit. */
export const DIAGNOSTICS_LIMITS = { reports: 8, name: 48, message: 72 } as const;

/** What one component reports about itself. */
export interface DiagnosticReport {
  /** The component's name. */
  name: string;
  /** How it is. */
  level: DiagnosticLevel;
  /** For people; may be empty. */
  message: string;
  /** Since when it has reported this level, robot's monotonic clock, ms. */
  sinceMs: number;
}

/** What the robot's components report about themselves. */
export interface Diagnostics {
  type: 'diagnostics';
  /** Where the reports come from. */
  topic: string;
  /** When the newest report came, robot's monotonic clock, ms. */
  timeMs: number;
  /** Number of components by level. */
  counts: Record<DiagnosticLevel, number>;
  /** Some of them. */
  reports: DiagnosticReport[];
  /** They are reports of the recording that the robot plays. */
  recorded?: true | undefined;
}

const count = z.int().check(z.minimum(0));
const timeMs = z.number().check(z.minimum(0));
const { reports, name, message } = DIAGNOSTICS_LIMITS;

export const diagnosticsSchema = z.strictObject({
  type: z.literal('diagnostics'),
  topic: z.string().check(z.minLength(1), z.maxLength(READING_LIMITS.topic)),
  timeMs,
  counts: z.strictObject({ error: count, warn: count, stale: count, ok: count }),
  reports: z
    .array(
      z.strictObject({
        name: z.string().check(z.maxLength(name)),
        level: z.enum(diagnosticLevels),
        message: z.string().check(z.maxLength(message)),
        sinceMs: timeMs,
      }),
    )
    .check(z.maxLength(reports)),
  recorded: z.optional(z.literal(true)),
}) satisfies z.ZodMiniType<Diagnostics>;
