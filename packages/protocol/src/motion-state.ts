/** What a robot makes of its driver's wish: how much of it, and why not all. Part of the telemetry. */
import * as z from 'zod/mini';
import { type Intervention, interventions } from './interventions.ts';
import { type ReturnState, returnStateSchema } from './return-state.ts';

/** Whether the robot looks where it goes. */
export const obstacleGuardStates = [
  'on', // it brakes for obstacles
  'blind', // it should, but no sensor can tell it of any now
  'off', // it does not, by its configuration
] as const;
/**
 * Whether the robot looks where it goes.
 *
 * @useDeclaredType
 */
export type ObstacleGuardState = (typeof obstacleGuardStates)[number];

/** What the robot makes of its driver's wish. */
export interface MotionState {
  /** Share of the requested velocity that the robot lets through, 0–1. */
  factor: number;
  /** Why it is less than 1, the strictest first; empty if it is 1. */
  reasons: readonly Intervention[];
  /** The fastest that the robot drives straight on now, m/s: at most its limit. */
  mostLinear: number;
  /** Age of what the driver sees when its command arrives, worst of the last second, ms. Left out while no command comes. */
  viewAgeMs?: number | undefined;
  /** Whether the driver must let go of the grip once before the robot moves again. Left out if not. */
  letGoFirst?: true | undefined;
  /** Whether the robot looks where it goes. Left out by robots that cannot. */
  obstacleGuard?: ObstacleGuardState | undefined;
  /** That it drives back by itself, or has done so since somebody last drove it. */
  return?: ReturnState | undefined;
}

const nonNegative = z.number().check(z.minimum(0));

export const motionStateSchema = z.strictObject({
  factor: z.number().check(z.minimum(0), z.maximum(1)),
  reasons: z.array(z.enum(interventions)).check(z.maxLength(interventions.length)),
  mostLinear: nonNegative,
  viewAgeMs: z.optional(nonNegative),
  letGoFirst: z.optional(z.literal(true)),
  obstacleGuard: z.optional(z.enum(obstacleGuardStates)),
  return: z.optional(returnStateSchema),
}) satisfies z.ZodMiniType<MotionState>;
